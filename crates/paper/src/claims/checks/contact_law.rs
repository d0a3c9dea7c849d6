//! The DEM's contact law as printed, compared with kinematics, energy and the motion that it causes.

use super::Check;
use crate::claims::finding::{Finding, ROUND_OFF, relative, violation, worst};
use crate::claims::notation::{FRICTION, STIFFNESS as INVERSE_EPSILON, range, scientific, values};
use crate::claims::printed::Sliding;
use crate::claims::truth::{NORMAL_STIFFNESS as STIFFNESS, RADIUS};
use crate::model::{HistoryUpdate, Stack};
use crate::theory::{LoadingOutcome, LoadingPhase};
use nalgebra::Vector2;

pub(crate) const CHECKS: &[Check] = &[
    Check::theory("overlap", |paper| {
        let deviations = [3.1, 3.39, 3.41].map(|distance| {
            // Interpenetration of the surfaces on the line of centres.
            let (right_of_left, left_of_right) = (RADIUS, distance - RADIUS);
            (paper.overlap(distance) - (right_of_left - left_of_right)).abs()
        });
        let compared = "positions of the two surfaces on the line of centres";
        Finding::identity(deviations, compared)
    }),
    Check::theory("normal-force", |paper| {
        let energy = |overlap: f64| 0.5 * STIFFNESS * overlap.max(0.0).powi(2);
        let damping = 0.6;
        let compared = r"derivative of the energy $k_n\Delta^2/2$, a dashpot that takes the power $\eta_n v^2$, nothing without contact";
        at_samples(30, compared, |sample| {
            let (overlap, velocity) = (0.1 * sample, 0.3 * (7.0 * sample).sin());
            let step = 1e-6;
            let spring = (energy(overlap + step) - energy(overlap - step)) / (2.0 * step);
            // The dashpot takes the power η v².
            let power = if overlap > 0.0 {
                -damping * velocity * velocity
            } else {
                0.0
            };
            let force = paper.normal_force(damping, overlap, velocity);
            ((force - spring) * velocity - power).abs()
        })
    }),
    Check::theory("tangential-spring", |paper| {
        let compared =
            r"power of the printed force against those of a spring $k_t$ and of a dashpot $\eta_t$";
        at_samples(30, compared, |sample| {
            let contact = Sliding {
                damping: 0.6,
                stretch: 0.1 * sample,
                velocity: (5.0 * sample).sin(),
                cap: f64::INFINITY,
            };
            let spring_power = -STIFFNESS * contact.stretch * contact.velocity;
            let dashpot_power = -contact.damping * contact.velocity * contact.velocity;
            (paper.sticking_force(&contact) * contact.velocity - spring_power - dashpot_power).abs()
        })
    }),
    Check::theory("pair-tangent", |paper| {
        let compared =
            r"product with the line of centres, and $\boldsymbol{n}$ turned by 90 degrees";
        at_samples(20, compared, |sample| {
            let separation = unit_vector(9.0 * sample) * 3.3;
            let tangent = paper.pair_tangent(separation);
            let quarter_turn = Vector2::new(-separation.y, separation.x).normalize();
            worst([
                tangent.dot(&separation).abs(),
                (tangent - quarter_turn).norm(),
            ])
        })
    }),
    // Surface velocities at the contact point are v + ω × arm, with arms r along the line of centres.
    Check::theory("tangential-velocity", |paper| {
        let compared = "velocities of the two surfaces from rigid motion with arms $r$";
        at_samples(20, compared, |sample| {
            let normal = unit_vector(9.0 * sample);
            let velocity = Vector2::new(sample, (3.0 * sample).cos());
            let spins = [(4.0 * sample).sin(), (6.0 * sample).sin()];
            let surface = |spin: f64, arm: Vector2<f64>| Vector2::new(-arm.y, arm.x) * spin;
            let difference =
                velocity + surface(spins[0], -normal * RADIUS) - surface(spins[1], normal * RADIUS);
            let tangent = Vector2::new(-normal.y, normal.x);
            let printed = paper.tangential_velocity(normal * 3.3, velocity, spins);
            (printed - difference.dot(&tangent)).abs()
        })
    }),
    // In a contact dragged at a constant speed the force rises to the cap and stays there, and the spring stops.
    Check::theory("stick", |paper| {
        let (cap, step) = (0.4, 1e-4);
        let mut contact = Sliding {
            damping: 0.0,
            stretch: 0.0,
            velocity: 0.1,
            cap,
        };
        let mut overshoot = 0.0f64;
        for _ in 0..40_000 {
            if paper.sticks(&contact) {
                contact.stretch += contact.velocity * step;
            }
            overshoot = overshoot.max(paper.tangential_force(&contact).abs() / cap - 1.0);
        }
        let stretch = relative(contact.stretch, cap / STIFFNESS);
        let one_step = contact.velocity * step * STIFFNESS / cap;
        let evidence = format!(
            "a contact dragged at constant speed: the force reaches the cap, never exceeds it, and the spring stops at \
             {} within one step (${}$)",
            r"$\mu\lvert\boldsymbol{f}_{ij}^{(n)}\rvert/k_t$",
            scientific(one_step, 1)
        );
        Finding::new(worst([overshoot, stretch]), 1.01 * one_step, evidence)
    }),
    // The force must be continuous at the Coulomb threshold, and defined where the contact does not move.
    Check::theory("cap-direction", |paper| {
        let (cap, damping) = (0.4, 0.05);
        let force = |stretch: f64, velocity: f64| {
            paper.tangential_force(&Sliding {
                damping,
                stretch,
                velocity,
                cap,
            })
        };
        let jump = |velocity: f64| {
            let threshold = (cap - damping * velocity) / STIFFNESS;
            let at = |part: f64| force(threshold * part, velocity);
            (at(1.0 + 1e-9) - at(1.0 - 1e-9)).abs() / cap
        };
        let loading = worst([1.0, 0.1, 1e-3].map(jump));
        let unloading = worst([-1e-3, -0.1, -1.0].map(jump));
        let undefined = force(1.0, 0.0).is_nan();
        let evidence = format!(
            "jump of the force as {SPRING_FORCE} passes the cap, in units of the cap: {loading:.2} while the spring is stretched \
             further, {unloading:.2} while it relaxes; a contact at rest with {SPRING_FORCE} above the cap has {} force",
            if undefined { "no defined" } else { "a defined" }
        );
        let deviation = worst([loading, unloading, violation(!undefined)]);
        Finding::new(deviation, ROUND_OFF, evidence)
    }),
    // Counts the stacks that yield at the floor in the paper but fall under their own weight with the printed cap
    // between cylinders.
    Check::theory("cap-between-cylinders", |paper| {
        let (frictions, stiffness) = ([0.12, 0.15, 0.2, 0.25], 1e3);
        let falls = |&mu: &f64| {
            let stack = Stack {
                cylinder_friction: paper.friction_between_cylinders(mu),
                ..Stack::paper(mu, stiffness)
            };
            let outcome = LoadingOutcome::of(&stack, HistoryUpdate::Fixed);
            outcome.is_none_or(|outcome| outcome.first.stage == LoadingPhase::OwnWeight)
        };
        let (fallen, all) = (frictions.into_iter().filter(falls).count(), frictions.len());
        let evidence = format!(
            "exact path of equilibria at {} with this cap between cylinders: {fallen} of {all} stacks with {} (Fig. 2(a) has \
             all of them yield under the wall) fall under their own weight, because $b/a = T \\ge \\mu_c$",
            values(INVERSE_EPSILON, &[stiffness]),
            range(FRICTION, &frictions)
        );
        Finding::new(fallen as f64 / all as f64, 0.0, evidence)
    }),
    // Torque of a tangential force k_t u with the arm r + r₁ δ, less that with the arm r.
    Check::theory("arm-correction", |paper| {
        let torque = |scale: f64, coefficient: f64| {
            let (overlap, stretch) = (0.3 * scale, 0.2 * scale);
            (RADIUS + coefficient * overlap) * STIFFNESS * stretch
        };
        let correction = |scale: f64| torque(scale, -0.5) - torque(scale, 0.0);
        let order = (correction(1e-2) / correction(1e-3)).log10();
        let evidence = format!(
            "the torque $(r + r_1\\delta_n)k_t u$ less $r k_t u$ falls with the displacements to the power {order:.6}. \
             Quadratic is not negligible: see the claim on $r_1 = 0$"
        );
        Finding::new((paper.arm_order - order).abs(), 1e-6, evidence)
    }),
    Check::theory("normal-damping", |paper| {
        let measured = restitution(MASS, STIFFNESS, paper.damping(MASS, STIFFNESS));
        let evidence = format!(
            "a cylinder thrown against a wall with this $\\eta_n$, integrated: restitution {measured:.5}"
        );
        restores(measured, evidence)
    }),
    Check::theory("tangential-damping", |paper| {
        let stiffness = STIFFNESS / paper.stiffness_ratio;
        let measured = restitution(MASS, stiffness, paper.damping(MASS, stiffness));
        let turning = restitution(MASS / 3.0, stiffness, paper.damping(MASS, stiffness));
        let evidence = format!(
            "a mass $m$ on a spring $k_t$ with this $\\eta_t$, integrated: restitution {measured:.5}. (A cylinder free to \
             turn has the tangential mass $m/3$ at a wall and {turning:.3}.)"
        );
        restores(measured, evidence)
    }),
    Check::theory("pair-restitution", |paper| {
        let measured = restitution(0.5 * MASS, STIFFNESS, paper.damping(MASS, STIFFNESS));
        let evidence = format!(
            "two cylinders thrown against each other with this $\\eta_n$ (reduced mass $m/2$), integrated: restitution {measured:.5}"
        );
        restores(measured, evidence)
    }),
];

/// TeX of |h_t|.
const SPRING_FORCE: &str = r"$\lvert\boldsymbol{h}_{ij}^{(t)}\rvert$";
const MASS: f64 = 0.8;
/// e_r of the paper.
const RESTITUTION: f64 = 0.7;

/// Checks an identity at `count` scattered numbers between −1 and 1.
fn at_samples(count: u32, compared: &str, deviation: impl Fn(f64) -> f64) -> Finding {
    let samples = (1..=count).map(|index| (f64::from(index) * 2.399_963).sin());
    Finding::identity(samples.map(deviation), compared)
}

/// Returns the unit vector at an angle from the x-axis.
fn unit_vector(angle: f64) -> Vector2<f64> {
    Vector2::new(angle.cos(), angle.sin())
}

/// Integrates a damped oscillator until its displacement is back at zero, half a period, and returns the restitution.
fn restitution(mass: f64, stiffness: f64, damping: f64) -> f64 {
    let step = 1e-3 * (mass / stiffness).sqrt();
    // The state is (x, v); the method is Runge–Kutta of fourth order.
    let rate = |state: Vector2<f64>| {
        Vector2::new(state.y, (-stiffness * state.x - damping * state.y) / mass)
    };
    let mut state = Vector2::new(0.0, 1.0);
    loop {
        let first = rate(state);
        let second = rate(state + 0.5 * step * first);
        let third = rate(state + 0.5 * step * second);
        let fourth = rate(state + step * third);
        let next = state + step * (first + 2.0 * second + 2.0 * third + fourth) / 6.0;
        if next.x <= 0.0 || !next.x.is_finite() {
            // Interpolating linearly within the last step has an error of second order in the step.
            let part = if state.x > 0.0 {
                state.x / (state.x - next.x)
            } else {
                f64::NAN
            };
            return -(state.y + part * (next.y - state.y));
        }
        state = next;
    }
}

/// Checks that the measured `restitution` is that of the paper, up to the error of the integration.
fn restores(restitution: f64, evidence: String) -> Finding {
    Finding::new((restitution - RESTITUTION).abs(), 1e-6, evidence)
}
