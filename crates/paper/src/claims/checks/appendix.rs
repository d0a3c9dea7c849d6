//! Appendix A: every equation, evaluated at solutions of the unreduced equations.

use super::Check;
use crate::claims::finding::{Finding, relative, worst};
use crate::claims::notation::{FRICTION, RATIO, STIFFNESS, number, range, values};
use crate::claims::printed::PaperTheory;
use crate::claims::truth::{
    Displacements, FRICTIONS, Forces, NORMAL_STIFFNESS, RADIUS, RATIOS, YieldState, yield_states,
};
use crate::study::yield_force::PAPER_STIFFNESSES;

pub(crate) const CHECKS: &[Check] = &[
    // Newton's method finds isolated solutions, because the Jacobian of the five equations is regular.
    Check::theory("five-unknowns", |_| {
        let expected = FRICTIONS.len() * PAPER_STIFFNESSES.len() * RATIOS.len();
        let found = yield_states().len();
        let evidence = format!(
            "Newton's method on the five equations (three balances of cylinder 2, one of cylinder 1, \
             $e = \\mu d$) in {UNKNOWNS}, with a regular Jacobian, has converged for {found} of {expected} stacks"
        );
        Finding::exceptions(expected - found, evidence)
    }),
    Check::at_states("slip-condition", PaperTheory::slip_condition),
    Check::at_states("first-of-xyz", PaperTheory::first_of_xyz),
    Check::at_states("second-of-xyz", PaperTheory::second_of_xyz),
    Check::at_states("third-of-xyz", PaperTheory::third_of_xyz),
    // Checks A, B and C in terms of the forces. S is the distance between the centres.
    //
    // From a = k_n [x(√3r − x) − y(r + y)]/S and b = e = μ k_n z; with r(x + √3y) = S (2μκz − y),
    // A = a S w²/k_n, B = b S w² z/(k_n z), C = S² w² z for w = 2μκz − y.
    Check::theory("auxiliary-functions", |paper| {
        at_states(|state| {
            let [a, b, c] = paper.auxiliary(state);
            let forces = state.forces();
            let moved = &state.displacements;
            let distance = (moved.upper() - moved.lower()).norm();
            // 2κμz = κ (b + e)/k_n is the stretch of both tangential springs together; that of the floor is y + rθ.
            let twice = state.ratio * (forces.b + forces.e) / NORMAL_STIFFNESS;
            let square = (twice - state.y()).powi(2);
            let squares = distance * distance * square;
            worst([
                relative(a, forces.a * distance * square / NORMAL_STIFFNESS),
                relative(b, forces.b * distance * square / NORMAL_STIFFNESS),
                relative(c, squares * forces.d / NORMAL_STIFFNESS),
            ])
        })
    }),
    Check::at_states("a-eliminated", PaperTheory::a_eliminated),
    Check::theory("factors-not-zero", |paper| {
        let factors = yield_states().iter().map(|state| {
            let shear = paper.shear(state) / (state.epsilon * RADIUS);
            shear.min(1.0 + state.y() / RADIUS)
        });
        let smallest = factors.fold(f64::INFINITY, f64::min);
        let evidence = format!(
            "{}: {FACTORS} are both at least {smallest:.3}",
            at_solutions()
        );
        Finding::statement(smallest > 0.0, evidence)
    }),
    Check::at_states("sum-relation", PaperTheory::sum_relation),
    Check::at_states("conjugate-relation", PaperTheory::conjugate_relation),
    Check::at_states("slope-relation", PaperTheory::slope_relation),
    Check::at_states("closed-form", PaperTheory::closed_form),
    // Checks whether "x, y, z ≥ 0" is necessary or sufficient for a, b, d and e to be positive.
    Check::theory("non-negative-variables", |paper| {
        let states = yield_states();
        let positive = |state: &&YieldState| {
            let Forces { a, b, d, e } = state.forces();
            [a, b, d, e].iter().all(|&force| force > 0.0)
        };
        let inward = states.iter().filter(|state| state.y() < 0.0);
        let needless = inward.clone().filter(positive).count();
        let inward = inward.count();
        // With x = 0 and y, z > 0 the normal force is −k_n y (r + y)/S.
        let moved = Displacements {
            delta_11: 0.01,
            delta_21: 0.01,
            delta_22: 0.02,
            theta: 0.0,
        };
        let pulling = paper.forces(&moved, paper.stiffness_ratio).a / NORMAL_STIFFNESS;
        let evidence = format!(
            "not necessary: of {inward} solutions with $y < 0$ ({}, {}), {needless} have $a, b, d, e > 0$; \
             not sufficient: $x = 0$, $y = {}r$, $z = {}r$ makes $a = {pulling:.4}k_n r < 0$. What $y \\ge 0$ does is keep \
             the bottom cylinders apart, $c = 0$",
            range(FRICTION, &FRICTIONS),
            values(RATIO, &RATIOS),
            number(moved.delta_22 / RADIUS),
            number(moved.delta_21 / RADIUS)
        );
        let violations = needless + usize::from(pulling < 0.0);
        Finding::exceptions(violations, evidence)
    }),
];

const UNKNOWNS: &str = r"$\delta_{11}$, $\delta_{21}$, $\delta_{22}$, $\theta$ and $f$";
const FACTORS: &str = r"$(x + \sqrt{3}y)/(\epsilon r)$ and $(r + y)/r$";

/// Describes the range of the yield states and the dimensions in which they are solved.
pub(super) fn range_of_states() -> String {
    format!(
        "{}, {}, {}; $r$ and $k_n$ not 1",
        range(FRICTION, &FRICTIONS),
        range(STIFFNESS, &PAPER_STIFFNESSES),
        values(RATIO, &RATIOS)
    )
}

fn at_solutions() -> String {
    let states = range_of_states();
    format!(
        "the two sides at solutions of the five unreduced equations (Newton's method; {states})"
    )
}

pub(crate) fn at_states(deviation: impl Fn(&YieldState) -> f64) -> Finding {
    Finding::identity(yield_states().iter().map(deviation), &at_solutions())
}
