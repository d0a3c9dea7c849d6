//! Appendix C: the limits of the analysis, by the elastic equation, the exact limit and its events.

use super::Check;
use crate::claims::finding::{Finding, worst};
use crate::claims::notation::{FRICTION, STIFFNESS, fixed, number, range, values};
use crate::claims::printed::PaperTheory;
use crate::claims::truth::{pairs, paper_limit};
use crate::model::{ContactConvention, HistoryUpdate, Problem, Stack};
use crate::study::yield_force::PAPER_STIFFNESSES;
use crate::theory::{
    Boundary, EquilibriumPath, Event, LoadingOutcome, bracketed_root, elastic_root, followed_limit,
};

pub(crate) const CHECKS: &[Check] = &[
    Check::theory("inward-friction", |paper| {
        let stiffnesses = [1e2, 1e3, 1e4, NEARLY_RIGID];
        let found = stiffnesses.map(|stiffness| last_outward(paper, stiffness));
        let exact = (1.0 - 1.0 / paper.stiffness_ratio).sqrt();
        let evidence = format!(
            "$y$ of the elastic equation changes sign at $\\mu$ of {} for {}, and at $\\sqrt{{1 - 1/\\kappa}} = {exact:.4}$ for \
             $\\epsilon \\to 0$",
            fixed(found, 4),
            values(STIFFNESS, &stiffnesses)
        );
        let deviation = worst(found.map(|mu| (mu - paper.inward_friction).abs()));
        // The bound is half a unit of the second digit, as if two were printed.
        Finding::new(deviation, 0.005, evidence)
    }),
    Check::theory("inward-solutions", |paper| {
        let frictions = [0.8, 0.85, 0.9, 0.95];
        let stacks: Vec<_> = pairs(frictions, PAPER_STIFFNESSES).collect();
        let inward = |&&(mu, stiffness): &&(f64, f64)| outward(paper, mu, stiffness) < 0.0;
        let right = stacks.iter().filter(inward).count();
        let evidence = format!(
            "the elastic equation has one root $z \\ge 3\\epsilon r/2$ with $y > -r$; at {right} of {} stacks ({}, {}) it has \
             $y < 0$",
            stacks.len(),
            range(FRICTION, &frictions),
            range(STIFFNESS, &PAPER_STIFFNESSES)
        );
        Finding::exceptions(stacks.len() - right, evidence)
    }),
    // Checks whether the bottom cylinders of a stack with μ ≥ 0.8 move inwards until they touch, y < 0.
    Check::theory("non-destructive", |paper| {
        let frictions = [0.8, 0.9];
        let stacks = pairs(frictions, PAPER_STIFFNESSES);
        let stacks: Vec<Stack> = stacks
            .map(|(mu, stiffness)| stack(paper, mu, stiffness))
            .collect();
        let [written, turned] = [HistoryUpdate::Fixed, HistoryUpdate::Rotated].map(|rule| {
            let outcomes = stacks
                .iter()
                .filter_map(|stack| LoadingOutcome::of(stack, rule));
            let ends: Vec<Event> = outcomes.map(|outcome| outcome.first.event).collect();
            [Event::ContactCloses, Event::WallContact]
                .map(|event| ends.iter().filter(|&&end| end == event).count())
        });
        let all = stacks.len();
        let ([inward, wall], [inward_turned, wall_turned]) = (written, turned);
        let evidence = format!(
            "exact path of equilibria with {}, $\\mu_d = {}$, {}: in {inward} of {all} stacks the bottom cylinders move inwards \
             to $y < 0$ ({inward_turned} with a spring that turns). What keeps them from yielding is that the top wall reaches \
             the bottom cylinders first, in {wall} ({wall_turned})",
            values(FRICTION, &frictions),
            number(paper.cylinder_friction),
            range(STIFFNESS, &PAPER_STIFFNESSES)
        );
        Finding::exceptions(all - inward, evidence)
    }),
    Check::theory("wall-contact", |paper| {
        let at = |stiffness| wall_contact_friction(paper, stiffness, HistoryUpdate::Fixed);
        let closed = at(paper.lowest_stiffness);
        let side = |mu: f64| {
            let stack = stack(paper, mu, paper.lowest_stiffness);
            let problem = Problem::new(stack, ContactConvention::PAPER).ok()?;
            Some(followed_limit(&problem).event)
        };
        let distance = 1e-4;
        let confirmed = side(closed - distance) == Some(Event::FloorSlip)
            && side(closed + distance) == Some(Event::WallContact);
        let stiffer = [1e3, 1e4];
        let evidence = format!(
            "exact quasi-static limit at {}: from $\\mu = {closed:.5}$ on the top wall reaches cylinder 2 before the floor \
             slips ({}confirmed by the path follower at $\\mu \\pm {}$); from {} on at {}. With a spring that turns from {} on at {}",
            values(STIFFNESS, &[paper.lowest_stiffness]),
            if confirmed { "" } else { "not " },
            number(distance),
            fixed(stiffer.map(at), 5),
            values(STIFFNESS, &stiffer),
            fixed(
                PAPER_STIFFNESSES.map(|stiffness| {
                    wall_contact_friction(paper, stiffness, HistoryUpdate::Rotated)
                }),
                5
            ),
            values(STIFFNESS, &PAPER_STIFFNESSES)
        );
        let deviation = confirmed.then_some((closed - paper.wall_contact_friction).abs());
        Finding::new(deviation.unwrap_or(f64::NAN), 0.005, evidence)
    }),
    // The concluding remarks use the friction of wall contact for the breakdown of the analysis.
    Check::theory("breakdown", |paper| {
        let last = last_outward(paper, NEARLY_RIGID);
        let (frictions, stiffness) = ([0.6, 0.65, 0.7], 1e4);
        let evidence = format!(
            "the analysis rests on $y > 0$, which the elastic equation gives up to $\\mu = {last:.3}$ ($y/r$ is {} at {}, \
             {}); ${}$ is what End Matter C says of wall contact in the DEM at $k_n r/mg = {}$",
            fixed(frictions.map(|mu| outward(paper, mu, stiffness)), 3),
            values(FRICTION, &frictions),
            values(STIFFNESS, &[stiffness]),
            number(paper.wall_contact_friction),
            number(paper.lowest_stiffness)
        );
        Finding::new((paper.breakdown_friction - last).abs(), 0.005, evidence)
    }),
    // Checks whether μ_d keeps the cylinders from slipping on each other in all stacks that yield at the floor in the
    // paper.
    Check::theory("cylinder-friction", |paper| {
        let frictions: Vec<f64> = (0..=10).map(|step| 0.1 + 0.04 * f64::from(step)).collect();
        let stiffnesses = [paper.lowest_stiffness, 1e3, paper.highest_stiffness];
        let mut highest = 0.0f64;
        let mut slips = 0;
        for stiffness in stiffnesses {
            for &mu in &frictions {
                let base = stack(paper, mu, stiffness);
                if let Some(outcome) = LoadingOutcome::of(&base, HistoryUpdate::Fixed) {
                    slips += usize::from(outcome.first.event == Event::CylinderSlip);
                }
                let limit = paper_limit(&base);
                highest = highest.max(limit.and_then(|limit| limit.pair_friction).unwrap_or(0.0));
            }
        }
        let evidence = format!(
            "path of equilibria, {}, {}: when the floor slips, the contact between cylinders needs a friction of at most \
             ${highest:.3}$, its whole tangential force over its normal force, and it slips first in {slips} of {} stacks; $\\mu_d$ in the \
             authors' program (compress.c): ${}$",
            range(FRICTION, &frictions),
            range(STIFFNESS, &stiffnesses),
            frictions.len() * stiffnesses.len(),
            number(AUTHORS_CYLINDER_FRICTION)
        );
        let wrong = usize::from(paper.cylinder_friction != AUTHORS_CYLINDER_FRICTION);
        Finding::exceptions(slips + wrong, evidence)
    }),
];

/// Friction between cylinders in compress.c of the authors' repository.
const AUTHORS_CYLINDER_FRICTION: f64 = 0.7;

/// 1/ε so large that the frictions of the elastic equation agree with those for ε → 0 to 8 digits.
const NEARLY_RIGID: f64 = 1e8;

fn stack(paper: &PaperTheory, mu: f64, stiffness: f64) -> Stack {
    Stack {
        cylinder_friction: paper.cylinder_friction,
        ..paper.stack(mu, stiffness)
    }
}

/// Returns y of the elastic equation, or NaN if it has no solution.
fn outward(paper: &PaperTheory, mu: f64, stiffness: f64) -> f64 {
    elastic_root(&stack(paper, mu, stiffness)).map_or(f64::NAN, |root| root.y)
}

/// Returns the friction at which y of the elastic equation changes sign.
fn last_outward(paper: &PaperTheory, stiffness: f64) -> f64 {
    bracketed_root(|mu| outward(paper, mu, stiffness), 0.5, 1.0).unwrap_or(f64::NAN)
}

/// Returns the floor friction above which the wall reaches cylinder 2 before the floor slips.
fn wall_contact_friction(paper: &PaperTheory, stiffness: f64, rule: HistoryUpdate) -> f64 {
    let base = stack(paper, 0.3, stiffness);
    let path = EquilibriumPath::new(&base, rule);
    let mut boundaries = Boundary::in_friction(&path, &base).into_iter();
    let wall = boundaries.find(|boundary| boundary.above == Event::WallContact);
    wall.map_or(f64::NAN, |boundary| boundary.floor_friction)
}
