//! Eqs. (6) to (10) and (12), and the statements around them.

use super::Check;
use crate::model::{Arms, CRITICAL_FRICTION, ContactConvention, Stack};
use crate::paper::claims::finding::{Finding, list, relative, worst};
use crate::paper::claims::printed::PaperTheory;
use crate::paper::claims::truth::{
    NORMAL_STIFFNESS, RADIUS, RATIOS, YieldState, elastic_displacement, figure_loads, pairs,
    yield_states,
};
use crate::theory::{elastic_root, pair_overlap, quasistatic_limit};

pub(crate) const CHECKS: &[Check] = &[
    Check::theory("epsilon", epsilon),
    Check::theory("floor-load", floor_load),
    Check::theory("lowest-displacement", lowest_displacement),
    Check::theory("elastic-equation", elastic_equation),
    Check::theory("script-d", script_d),
    Check::theory("script-e", script_e),
    Check::theory("stiff-displacement", stiff_displacement),
    Check::theory("stiff-displacement-changes-sign", changes_sign),
    Check::theory("stiff-displacement-is-the-limit", stiff_limit),
    Check::theory("stiff-displacement-of-dem", stiff_limit_of_dem),
    Check::theory("small-displacements", small_displacements),
    Check::theory("slip-above-critical", slip_above_critical),
    Check::theory("quantitative-prediction", quantitative_prediction),
    Check::theory("elastic-equation-of-dem", elastic_equation_of_dem),
    Check::theory("arm-of-dem", arm_of_dem),
];

const STATES: &str = "solutions of the five unreduced equations (mu = 0.1 to 0.7, 1/epsilon = 1e2 to 1e4, \
                      kappa = 1, 2.5, 10; r and k_n not 1)";

fn at_states(compared: &str, deviation: impl Fn(&YieldState) -> f64) -> Finding {
    Finding::identity(
        yield_states().iter().map(deviation),
        &format!("{compared}; {STATES}"),
    )
}

/// A cylinder alone on the floor sinks by ε r.
fn epsilon(paper: &PaperTheory) -> Finding {
    let deviations = [1e-4, 1e-2, 0.3].map(|weight| {
        let sinking = weight / NORMAL_STIFFNESS;
        relative(
            paper.epsilon(weight, NORMAL_STIFFNESS, RADIUS) * RADIUS,
            sinking,
        )
    });
    let compared = "epsilon r against how far one cylinder sinks into the floor under its weight";
    Finding::identity(deviations, compared)
}

fn floor_load(paper: &PaperTheory) -> Finding {
    let compared = "(f + 3mg)/mg of the solution against 2z/(epsilon r)";
    at_states(compared, |state| {
        let load = state.force / state.weight() + 3.0;
        relative(paper.floor_load(state.z(), state.epsilon, RADIUS), load)
    })
}

fn lowest_displacement(paper: &PaperTheory) -> Finding {
    // Three cylinders at rest on two floor contacts.
    let truth = 3.0 / 2.0;
    Finding::identity(
        [
            relative(paper.lowest_displacement, truth),
            relative(paper.floor_load(truth, 1.0, 1.0), 3.0),
        ],
        "z/(epsilon r) of three weights on two floor contacts, f = 0",
    )
}

fn elastic_equation(paper: &PaperTheory) -> Finding {
    at_states("z against r D E at the solution's own alpha", |state| {
        paper.closed_form(state)
    })
}

/// 𝒟 = (T² + 2√3 T − 1)/(T (1 + T²))/(1 − α) with T read off the solution's geometry.
fn script_d(paper: &PaperTheory) -> Finding {
    let compared = "D against its value in terms of the angle of the line of centres";
    at_states(compared, |state| {
        let tangent = state.half_angle_tangent();
        let square = tangent * tangent;
        let truth = (square + 2.0 * 3f64.sqrt() * tangent - 1.0) / (tangent * (1.0 + square));
        let printed = paper.geometry(state.friction, state.alpha()) * (1.0 - state.alpha());
        // 𝒟 vanishes with the displacements, but its terms are of order 1: the deviation is relative to them.
        (printed - truth).abs()
    })
}

/// ℰ = 1/(1 + κ(1 + T²)).
fn script_e(paper: &PaperTheory) -> Finding {
    let compared = "E against its value in terms of the angle of the line of centres";
    at_states(compared, |state| {
        let tangent = state.half_angle_tangent();
        let truth = 1.0 / (1.0 + state.ratio * (1.0 + tangent * tangent));
        relative(
            paper.compliance(state.friction, state.ratio, state.alpha()),
            truth,
        )
    })
}

const WIDE: [f64; 8] = [0.1, 0.15, 0.2, 0.25, 0.28, 0.3, 0.5, 0.7];

fn stiff_displacement(paper: &PaperTheory) -> Finding {
    let deviations = pairs(WIDE, RATIOS).map(|(mu, kappa)| {
        let square = mu * mu;
        let numerator = square + 2.0 * 3f64.sqrt() * mu - 1.0;
        let truth = RADIUS * numerator / (mu * (1.0 + square)) / (1.0 + kappa * (1.0 + square));
        relative(paper.stiff_displacement(mu, kappa, RADIUS), truth)
    });
    let compared = "the right side of the elastic equation at alpha = 0, in terms of T = mu";
    Finding::identity(deviations, compared)
}

fn changes_sign(paper: &PaperTheory) -> Finding {
    let kappa = paper.stiffness_ratio;
    let at = |mu: f64| paper.stiff_displacement(mu, kappa, 1.0);
    let (below, above) = (at(CRITICAL_FRICTION - 1e-9), at(CRITICAL_FRICTION + 1e-9));
    let evidence =
        format!("z_star is {below:.2e} r at mu_c - 1e-9 and {above:.2e} r at mu_c + 1e-9");
    Finding::statement(below < 0.0 && above > 0.0, evidence)
}

fn stiff_limit(paper: &PaperTheory) -> Finding {
    let largest = worst([0.28, 0.3, 0.4, 0.5, 0.7].map(|mu| {
        let printed = paper.stiff_displacement(mu, paper.stiffness_ratio, 1.0);
        relative(elastic_displacement(&paper.stack(mu, 1e8)), printed)
    }));
    let evidence = format!(
        "root of the elastic equation at 1/epsilon = 1e8 against z_star, mu = 0.28 to 0.7: largest relative \
         difference {largest:.1e} (it falls as epsilon)"
    );
    Finding::new(largest, 1e-4, evidence)
}

fn stiff_limit_of_dem(paper: &PaperTheory) -> Finding {
    let differences = [0.28, 0.3, 0.4, 0.5].map(|mu| {
        let exact = pair_overlap(mu - CRITICAL_FRICTION, paper.stiffness_ratio);
        (
            mu,
            paper.stiff_displacement(mu, paper.stiffness_ratio, 1.0) / exact - 1.0,
        )
    });
    let listed =
        differences.map(|(mu, difference)| format!("{:+.2} % at mu = {mu}", 100.0 * difference));
    let evidence = format!(
        "z_star against the displacement G(mu) at which the DEM's exact quasi-static limit slips for epsilon -> 0: {}",
        list(listed)
    );
    Finding::new(
        worst(differences.map(|(_, difference)| difference.abs())),
        1e-3,
        evidence,
    )
}

fn small_displacements(_: &PaperTheory) -> Finding {
    let displacements = [0.2, 0.3, 0.5].map(|mu| {
        let limit = quasistatic_limit(&Stack::paper(mu, 1e8), &ContactConvention::PAPER);
        (mu, limit.z.unwrap_or(f64::NAN))
    });
    let listed = displacements.map(|(mu, z)| format!("{z:.1e} r at mu = {mu}"));
    let evidence = format!(
        "z at yield in the exact quasi-static limit at 1/epsilon = 1e8: {}. Above mu_c displacements do not become small \
         as epsilon -> 0, and the springs' linearisation is off there at any stiffness",
        list(listed)
    );
    Finding::new(worst(displacements.map(|(_, z)| z)), 1e-3, evidence)
}

fn slip_above_critical(_: &PaperTheory) -> Finding {
    let frictions = [0.27, 0.3, 0.4, 0.5];
    let forces = frictions
        .map(|mu| quasistatic_limit(&Stack::paper(mu, 1e2), &ContactConvention::PAPER).yield_force);
    let yields = forces.iter().flatten().count();
    let evidence = format!(
        "the exact quasi-static limit at 1/epsilon = 1e2 yields at the floor for {yields} of {} frictions above mu_c \
         (0.27 to 0.5), at a finite force",
        frictions.len()
    );
    Finding::exceptions(frictions.len() - yields, evidence)
}

/// Largest deviation of F + 3 from the exact quasi-static limit over Fig. 2(a), and where.
fn over_figure(load: impl Fn(&Stack) -> f64) -> (f64, f64, f64) {
    let compared = figure_loads().iter().map(|(stack, exact)| {
        let deviation = relative(load(stack), *exact);
        (deviation, stack.floor_friction, stack.stiffness)
    });
    // In this order a deviation that is not a number is the largest.
    let largest = compared.max_by(|left, right| left.0.total_cmp(&right.0));
    largest.unwrap_or((f64::NAN, f64::NAN, f64::NAN))
}

fn quantitative_prediction(paper: &PaperTheory) -> Finding {
    let load = |stack: &Stack| {
        paper.perturbative_load(stack.floor_friction, paper.stiffness_ratio, stack.epsilon())
    };
    let (deviation, mu, stiffness) = over_figure(load);
    let evidence = format!(
        "f_epsilon + 3mg against the DEM's exact quasi-static limit, mu = 0.1 to 0.5, 1/epsilon = 1e2 to 1e4: at most \
         {:.1} % off (mu = {mu:.2}, 1/epsilon = {stiffness:.0})",
        100.0 * deviation
    );
    Finding::new(deviation, 1e-3, evidence)
}

fn elastic_equation_of_dem(_: &PaperTheory) -> Finding {
    let load = |stack: &Stack| elastic_root(stack).map_or(f64::NAN, |root| root.load);
    let (deviation, mu, stiffness) = over_figure(load);
    let at = |mu: f64| {
        let stack = Stack::paper(mu, 1e4);
        let exact = quasistatic_limit(&stack, &ContactConvention::PAPER)
            .yield_force
            .unwrap_or(f64::NAN);
        100.0 * (load(&stack) / (exact + 3.0) - 1.0)
    };
    let evidence = format!(
        "solution of the elastic equation against the DEM's exact quasi-static limit, mu = 0.1 to 0.5, 1/epsilon = 1e2 to \
         1e4: F + 3 at most {:.1} % off (mu = {mu:.2}, 1/epsilon = {stiffness:.0}); at 1e4, {:+.2} % at mu = 0.2, \
         {:+.2} % at 0.3",
        100.0 * deviation,
        at(0.2),
        at(0.3)
    );
    Finding::new(deviation, 1e-3, evidence)
}

fn arm_of_dem(_: &PaperTheory) -> Finding {
    let half_way = Arms::reciprocal(-0.5, -1.0);
    let change = |mu: f64, stiffness: f64| {
        let stack = Stack::paper(mu, stiffness);
        let force = |arms| {
            quasistatic_limit(&stack, &ContactConvention::with_arms(arms))
                .floor_slip_force
                .unwrap_or(f64::NAN)
        };
        force(half_way) / force(Arms::PAPER) - 1.0
    };
    let changes = [1e2, 1e3, 1e4].map(|stiffness| change(0.3, stiffness));
    let below = change(0.2, 1e4);
    let evidence = format!(
        "exact quasi-static limit with the contact point on the undeformed floor and half-way between cylinders \
         (r1 = -1 and -1/2) against r1 = 0: F changes by {:+.1} %, {:+.1} %, {:+.1} % at mu = 0.3, 1/epsilon = 1e2, 1e3, 1e4, and \
         by {:+.2} % at mu = 0.2, 1e4. Above mu_c it does not vanish for stiff cylinders",
        100.0 * changes[0],
        100.0 * changes[1],
        100.0 * changes[2],
        100.0 * below
    );
    Finding::new(worst(changes.map(f64::abs)), 1e-2, evidence)
}
