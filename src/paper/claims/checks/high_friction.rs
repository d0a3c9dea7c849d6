//! Appendix C: the limits of the analysis, by the elastic equation, the exact limit and its events.

use super::Check;
use crate::model::{ContactConvention, Stack};
use crate::paper::claims::finding::{Finding, list, worst};
use crate::paper::claims::printed::PaperTheory;
use crate::paper::claims::truth::pairs;
use crate::theory::{
    Boundary, EquilibriumPath, Event, LoadingOutcome, bracketed_root, elastic_root, followed_limit,
};

pub(crate) const CHECKS: &[Check] = &[
    Check::theory("inward-friction", |paper| {
        let found = [1e2, 1e3, 1e4, 1e8].map(|stiffness| last_outward(paper, stiffness));
        let exact = (1.0 - 1.0 / paper.stiffness_ratio).sqrt();
        let evidence = format!(
            "y of the elastic equation changes sign at mu = {:.4}, {:.4}, {:.4} for 1/epsilon = 1e2, 1e3, 1e4, and at (1 - 1/kappa)^(1/2) = {exact:.4} for \
             epsilon -> 0 ({:.4} at 1e8)",
            found[0], found[1], found[2], found[3]
        );
        let deviation = worst(found.map(|mu| (mu - paper.inward_friction).abs()));
        // Two printed digits would mean half a unit of the second.
        Finding::new(deviation, 0.005, evidence)
    }),
    Check::theory("inward-solutions", |paper| {
        let stacks = pairs([0.8, 0.85, 0.9, 0.95], [1e2, 1e3, 1e4]);
        let inward = |&(mu, stiffness): &(f64, f64)| outward(paper, mu, stiffness) < 0.0;
        let right = stacks.filter(inward).count();
        let evidence = format!(
            "the elastic equation has one root z >= 3 epsilon r/2 with y > -r; at {right} of 12 stacks (mu = 0.8 to 0.95, 1/epsilon = 1e2 \
             to 1e4) it has y < 0"
        );
        Finding::exceptions(12 - right, evidence)
    }),
    // Whether a stack with μ ≥ 0.8 withstands any force.
    Check::theory("non-destructive", |paper| {
        let stacks = pairs([0.8, 0.9], [1e2, 1e3, 1e4]);
        let stacks = stacks.map(|(mu, stiffness)| stack(paper, mu, stiffness));
        let ends: Vec<_> = stacks
            .filter_map(|stack| LoadingOutcome::of(&stack))
            .collect();
        let ends = ends.iter().map(|outcome| outcome.first.event);
        let count = |events: &[Event]| ends.clone().filter(|end| events.contains(end)).count();
        let wall = count(&[Event::WallContact]);
        let slips = count(&[Event::FloorSlip, Event::CylinderSlip]);
        let evidence = format!(
            "exact path of equilibria with mu = 0.8 and 0.9, mu_d = 0.7, 1/epsilon = 1e2 to 1e4: in {wall} of 6 stacks the top wall reaches the \
             bottom cylinders first, in {slips} a contact slips first; none is left standing by y < 0, which is not reached"
        );
        Finding::exceptions(6 - wall, evidence)
    }),
    Check::theory("wall-contact", |paper| {
        let closed = wall_contact_friction(paper, paper.lowest_stiffness);
        let side = |mu: f64| {
            followed_limit(
                &stack(paper, mu, paper.lowest_stiffness),
                &ContactConvention::PAPER,
            )
            .event
        };
        let confirmed =
            side(closed - 1e-4) == Event::FloorSlip && side(closed + 1e-4) == Event::WallContact;
        let evidence = format!(
            "exact quasi-static limit at 1/epsilon = 1e2: from mu = {closed:.5} on the top wall reaches cylinder 2 before the floor slips ({}confirmed by \
             the path follower at mu +- 1e-4); {:.5} at 1e3 and {:.5} at 1e4",
            if confirmed { "" } else { "not " },
            wall_contact_friction(paper, 1e3),
            wall_contact_friction(paper, 1e4)
        );
        let deviation = confirmed.then_some((closed - paper.wall_contact_friction).abs());
        Finding::new(deviation.unwrap_or(f64::NAN), 0.005, evidence)
    }),
    // The concluding remarks use the friction of wall contact for the breakdown of the analysis.
    Check::theory("breakdown", |paper| {
        let last = last_outward(paper, 1e8);
        let roots = [0.6, 0.65, 0.7].map(|mu| format!("{:.3}", outward(paper, mu, 1e4)));
        let evidence = format!(
            "the analysis rests on y > 0, which the elastic equation gives up to mu = {last:.3} (y = {} r at mu = 0.6, 0.65, 0.7, \
             1/epsilon = 1e4); 0.58 is what End Matter C says of wall contact in the DEM at k_n r/mg = 1e2",
            list(roots)
        );
        Finding::new((paper.breakdown_friction - last).abs(), 0.005, evidence)
    }),
    // Whether μ_d keeps the cylinders from slipping on each other wherever the paper has the floor yield.
    Check::theory("cylinder-friction", |paper| {
        let mut highest = 0.0f64;
        let mut slips = 0;
        for stiffness in [paper.lowest_stiffness, 1e3, paper.highest_stiffness] {
            for step in 0..=10 {
                let base = stack(paper, 0.1 + 0.04 * f64::from(step), stiffness);
                if let Some(outcome) = LoadingOutcome::of(&base) {
                    slips += usize::from(outcome.first.event == Event::CylinderSlip);
                    highest = highest.max(outcome.first.tangent);
                }
            }
        }
        let evidence = format!(
            "exact path, mu = 0.1 to 0.5, 1/epsilon = 1e2 to 1e4: the contact between cylinders needs at most b/a = {highest:.3} by the time of yield, \
             and slips first in {slips} of 33 stacks"
        );
        Finding::exceptions(slips, evidence)
    }),
];

fn stack(paper: &PaperTheory, mu: f64, stiffness: f64) -> Stack {
    Stack {
        cylinder_friction: paper.cylinder_friction,
        ..paper.stack(mu, stiffness)
    }
}

/// y of the elastic equation; not a number without a solution.
fn outward(paper: &PaperTheory, mu: f64, stiffness: f64) -> f64 {
    elastic_root(&stack(paper, mu, stiffness)).map_or(f64::NAN, |root| root.y)
}

/// The friction at which y of the elastic equation changes sign.
fn last_outward(paper: &PaperTheory, stiffness: f64) -> f64 {
    bracketed_root(|mu| outward(paper, mu, stiffness), 0.5, 1.0).unwrap_or(f64::NAN)
}

/// The floor friction above which the wall reaches cylinder 2 before the floor slips.
fn wall_contact_friction(paper: &PaperTheory, stiffness: f64) -> f64 {
    let base = stack(paper, 0.3, stiffness);
    let mut boundaries = Boundary::in_friction(&EquilibriumPath::new(&base), &base).into_iter();
    let wall = boundaries.find(|boundary| boundary.above == Event::WallContact);
    wall.map_or(f64::NAN, |boundary| boundary.floor_friction)
}
