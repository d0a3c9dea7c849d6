//! The sum of the heights of a stack with linear springs: one oscillator, whatever happens between the bodies.
//!
//! Floor and top wall are springs of the same stiffness w with dashpots of the same coefficient η. Forces between
//! bodies cancel in the sum, and forces along the floor have no vertical component. So the sum Y of all n + 1 heights
//! obeys
//!
//! Ÿ + η Ẏ + w Y = const − (n + 1) g − η Ẇ − w W,
//!
//! where W is the travel of the wall and Ÿ is the imbalance of floor and wall. Each change of the wall speed by Δv
//! adds to Ÿ an oscillation with the envelope Δv w/ω_d e^(−η t/2), ω_d² = w − η²/4 (docs/theory.md, section 8.6).

use super::digits::COORDINATE;
use crate::model::{Case, ContactConvention, ContactLaw, Power, PreparationSteps, Schedule, Stack};

/// Number of time steps by which an oscillation may be younger than a row says: the wall may begin to move one step
/// later, and forces may be taken one step earlier.
const LATE_STEPS: f64 = 2.0;

/// The oscillation of the sum of the heights since the preparation, in k_n r and √(m/k_n).
#[derive(Debug, Clone, Copy)]
pub(super) struct Oscillator {
    /// w.
    stiffness: f64,
    /// η.
    damping: f64,
    time_step: f64,
    /// Time by which the forces that move the bodies lag behind the positions.
    force_lag: f64,
    /// Initial envelope after a sudden change of the wall speed by 1.
    of_speed: f64,
    /// Speed of the wall at its first touch.
    touch: f64,
    /// Speed that the wall loses while it slows down.
    slowing: f64,
    /// When the wall begins to slow down, and how long it takes.
    slows: [f64; 2],
    /// Weight of the stack.
    weight: f64,
    /// Durations of the gravity ramp and of the rest after it.
    rises: [f64; 2],
    /// Motions of the stack before the wall touches.
    standing: Standing,
}

/// Bounds for the motions of a stack that stands on the floor without a wall. The sum of the heights is not an
/// oscillator then, because the body on top lacks the spring of the wall.
#[derive(Debug, Clone, Copy)]
struct Standing {
    /// Lower bound of all frequencies.
    frequency: f64,
    /// Lower bound of all decay rates.
    decay: f64,
}

impl Standing {
    /// For a stack whose pairs have the stiffness k, the lowest frequency obeys
    ///
    /// 1/ω⁴ ≤ (0.95/k)² + (1.55/w)² + (0.75/k_t)²,
    ///
    /// where k_t is the lowest tangential stiffness (lowest eigenvalues, computed for two to five bodies on the floor,
    /// moments of inertia from 0.4 to 1, w from 0.1 to 10, κ from 1e-3 to 1e4, and a κ of the floor from 0.1 to 10
    /// times that). Dashpots η beside springs k damp it at a rate of at least ω² η/(2k), with η/k of the contact where
    /// it is least.
    ///
    /// Forces that lag by a time take that from every η/k.
    fn of(laws: [&ContactLaw; 2], force_lag: f64) -> Self {
        let [pair, wall] = laws;
        let tangential = pair.tangential_stiffness.min(wall.tangential_stiffness);
        let sum = (0.95 / pair.normal_stiffness).powi(2)
            + (1.55 / wall.normal_stiffness).powi(2)
            + (0.75 / tangential).powi(2);
        let lags = laws.map(|law| {
            let normal = law.damping_normal / law.normal_stiffness;
            normal.min(law.damping_tangential / law.tangential_stiffness)
        });
        let square = sum.sqrt().recip();
        Self {
            frequency: square.sqrt(),
            decay: 0.5 * square * (lags[0].min(lags[1]) - force_lag).max(0.0),
        }
    }
}

/// Returns an upper bound of how far, in r, a wall that touches `stack` at this `speed` may still move a body about
/// its rest after this `time`. The load of the wall stiffens contacts, so motions decay faster than that.
pub fn left_of_touch(stack: &Stack, convention: &ContactConvention, speed: f64, time: f64) -> f64 {
    let about_rest = |law: ContactLaw| {
        let overlap = law.overlap(stack.epsilon() / f64::from(stack.bodies));
        let there = law.at(overlap);
        ContactLaw {
            normal_stiffness: law.stiffness(overlap),
            tangential_stiffness: there.tangential_stiffness,
            damping_normal: there.damping_normal,
            damping_tangential: there.damping_tangential,
            ..law
        }
    };
    let pair = about_rest(convention.law(stack.stiffness_ratio));
    let wall = about_rest(convention.wall_law(stack.stiffness_ratio));
    let Standing { frequency, decay } = Standing::of([&pair, &wall], 0.0);
    speed / frequency * libm::exp(-decay * time)
}

impl Oscillator {
    /// The oscillator of `case`, with the `laws` of pairs and walls, in a code whose forces lag behind the positions by
    /// up to a time `force_lag`. `None` where the sum of the heights is not an
    /// oscillator: where forces are not linear, where side walls leave the bodies with velocities of unknown size, and
    /// where the time step is too long for an oscillation.
    pub(super) fn of(
        case: &Case,
        laws: [&ContactLaw; 2],
        schedule: &Schedule,
        force_lag: f64,
    ) -> Option<Self> {
        let wall = laws[1];
        let protocol = &case.protocol;
        let PreparationSteps::GravityRamp { ramp, rest } = schedule.preparation else {
            return None;
        };
        let (stiffness, damping) = (wall.normal_stiffness, wall.damping_normal);
        let time_step = protocol.time_step;
        let square = stiffness - 0.25 * (damping + stiffness * time_step).powi(2);
        if wall.power != Power::Linear || square <= 0.0 {
            return None;
        }
        let duration = |steps: u64| steps as f64 * time_step;
        Some(Self {
            stiffness,
            damping,
            time_step,
            force_lag,
            of_speed: stiffness / square.sqrt(),
            touch: protocol.fast_speed(),
            slowing: protocol.fast_speed() - protocol.wall_speed,
            slows: [schedule.fast_steps, schedule.slowing_steps].map(duration),
            weight: case.stack.own_weight() * case.stack.epsilon(),
            rises: [ramp, rest].map(duration),
            standing: Standing::of(laws, force_lag),
        })
    }

    /// √w.
    fn frequency(&self) -> f64 {
        self.stiffness.sqrt()
    }

    /// Time by which the wall has surely touched.
    pub(super) fn touched(&self) -> f64 {
        LATE_STEPS * self.time_step
    }

    /// Lower bound of the decay rate of any motion of the stack. The wall adds a spring, which makes no motion slower.
    pub(super) fn slowest_decay(&self) -> f64 {
        self.standing.decay
    }

    /// Returns the largest possible imbalance of floor and wall at this `time` after the wall began to move: the sum
    /// of what remains of the touch of the wall, its slowing down and the gravity ramp, and of what rounding sustains.
    ///
    /// In every code, rows that fall on a crest reach the envelopes. There is no safety factor beyond the effect of
    /// the time step: a dashpot sees a velocity between half a step before (as in all codes known here) and half a
    /// step later, and the wall starts to move at the touch or up to one step earlier or later. This changes an
    /// amplitude to first order in the step, by less than √w Δt, and also the decay rate. So does a lag of the forces.
    pub(super) fn bound(&self, time: f64) -> f64 {
        let left = self.after_touch(time) + self.after_slowing(time) + self.after_ramp(time);
        let late = self.time_step + self.force_lag;
        (1.0 + self.frequency() * late) * left + self.rounding(time)
    }

    /// Largest fraction of an oscillation that remains at an `age`, which is known to a few steps. Dashpots with the
    /// velocities of half a step later give (1 + η Δt)^(−t/2Δt), which is more than e^(−η t/2). Forces that lag by a time
    /// l add up to w l Δt (1 + 2 η Δt) to the square of what a step leaves; an oscillation that would grow is taken not to
    /// decay.
    fn decayed(&self, age: f64) -> f64 {
        let least = (age - LATE_STEPS * self.time_step).max(0.0);
        let damped = self.damping * self.time_step;
        let gained = self.stiffness * self.force_lag * self.time_step * (1.0 + 2.0 * damped);
        let rate =
            0.5 * (libm::log1p(damped) - libm::log1p(gained * (1.0 + damped))) / self.time_step;
        libm::exp(-rate.max(0.0) * least)
    }

    fn after_touch(&self, time: f64) -> f64 {
        self.touch * self.of_speed * self.decayed(time)
    }

    fn after_slowing(&self, time: f64) -> f64 {
        let [begin, duration] = self.slows;
        let since = time - begin;
        if duration <= 0.0 || since + LATE_STEPS * self.time_step < 0.0 {
            return 0.0;
        }
        let part = match since < duration + LATE_STEPS * self.time_step {
            true => while_rising(self.frequency() * duration),
            false => left_by(self.frequency() * duration) * self.decayed(since - duration),
        };
        self.slowing * self.of_speed * part
    }

    /// The weight of all bodies together acts on all motions of the standing stack. The accelerations that remain of
    /// them add up to a ≤ (n + 1) g times the fraction that remains of the slowest. The touch turns an acceleration a
    /// of Y, its velocity a/ω, and the dashpot that begins to act between wall and body into an oscillation with the
    /// envelope (√w/ω_d) a (√2 + 3 √w/ω), or less.
    fn after_ramp(&self, time: f64) -> f64 {
        let [duration, rest] = self.rises;
        let Standing { frequency, decay } = self.standing;
        let rested = (rest - LATE_STEPS * self.time_step).max(0.0);
        let left = self.weight * left_by(frequency * duration) * libm::exp(-decay * rested);
        let of_force = self.of_speed / self.frequency();
        let factor = std::f64::consts::SQRT_2 + 3.0 * self.frequency() / frequency;
        of_force * factor * left * self.decayed(time)
    }

    /// Heights and the wall are rounded in every step. While a speed hardly changes, all its roundings are alike; this
    /// acts as another speed, off by up to one rounding per step, which changes suddenly when the speed crosses a
    /// digit. Otherwise rounding errors are random, and the oscillator remembers them for a time 2/η, or since the
    /// beginning.
    fn rounding(&self, time: f64) -> f64 {
        let run = self.rises[0] + self.rises[1] + time;
        let remembered = (2.0 / self.damping).min(run) / self.time_step;
        let at_random = self.frequency() * remembered.max(1.0).sqrt();
        self.of_speed * COORDINATE * (at_random + self.time_step.recip())
    }
}

/// Amplitude of an oscillation of frequency ω after a change that rises as the smooth step χ in a time T, as a
/// fraction of that after a sudden change; `phase` is ω T. It is |∫χ' e^(λ(T−t)) dt| with |λ| = ω at the end of the
/// rise, integrated by parts. χ' and χ'' vanish at both ends; the next derivatives there are 60, 360 and 720, in units
/// of T.
fn left_by(phase: f64) -> f64 {
    (2.0 * at_an_end(phase)).min(1.0)
}

/// The same fraction during the rise, where χ' and χ'' are at most 15/8 and 10/√3.
fn while_rising(phase: f64) -> f64 {
    let slopes = 1.875 / phase + 10.0 / (3f64.sqrt() * phase * phase);
    (slopes + 2.0 * at_an_end(phase)).min(1.0)
}

fn at_an_end(phase: f64) -> f64 {
    (60.0 + (360.0 + 720.0 / phase) / phase) / phase.powi(3)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::{
        ContactConvention, Law, PAPER_RESTITUTION, Preparation, Protocol, Sampling, Shortcuts,
        SideWalls, Stack,
    };

    const SPEED: f64 = 1e-5;

    /// A case whose gravity ramp leaves no oscillation.
    fn case(restitution: f64, floor_ratio: f64, time_step: f64) -> Case {
        Case {
            stack: Stack::paper(0.3, 1e3),
            convention: ContactConvention {
                restitution,
                law: Law {
                    floor_ratio,
                    ..Law::LINEAR
                },
                ..ContactConvention::PAPER
            },
            protocol: Protocol {
                preparation: Preparation::GravityRamp {
                    ramp_time: 4000.0,
                    rest_time: 400.0,
                },
                time_step,
                wall_speed: SPEED,
                wall_travel: 2e-3,
                sampling: Sampling {
                    coarse_interval: 1.0,
                    fine_from_travel: 1e-3,
                    fine_interval: 1.0,
                },
                shortcuts: None,
            },
        }
    }

    fn of_lag(case: &Case, force_lag: f64) -> Option<Oscillator> {
        let (convention, ratio) = (&case.convention, case.stack.stiffness_ratio);
        let laws = [convention.law(ratio), convention.wall_law(ratio)];
        let schedule = case.protocol.schedule();
        Oscillator::of(case, [&laws[0], &laws[1]], &schedule, force_lag)
    }

    fn of(case: &Case) -> Option<Oscillator> {
        of_lag(case, 0.0)
    }

    fn oscillator(case: &Case) -> Oscillator {
        of(case).expect("it oscillates")
    }

    /// How a code integrates.
    #[derive(Debug, Clone, Copy)]
    struct Scheme {
        /// The velocities that dashpots see, from those of half a step before (0) to those of half a step later (1).
        later: f64,
        /// The step in which the wall begins to move.
        begins: i64,
        /// Whether the forces of the step before move the body.
        is_late: bool,
    }

    impl Scheme {
        const NATIVE: Self = Self {
            later: 0.0,
            begins: 0,
            is_late: false,
        };

        /// The wall has its speed before the first step.
        const EARLY: Self = Self {
            begins: -1,
            ..Self::NATIVE
        };
    }

    /// The imbalance in every step from the touch on, by stepping the sum of the heights from rest.
    fn stepped(case: &Case, scheme: Scheme) -> Vec<f64> {
        let Scheme {
            later,
            begins,
            is_late,
        } = scheme;
        let own = oscillator(case);
        let (protocol, schedule) = (&case.protocol, case.protocol.schedule());
        let dt = protocol.time_step;
        let of_wall = |step: i64| {
            let since = u64::try_from(step - begins);
            since.map_or(0.0, |since| protocol.speed_at(&schedule, since))
        };
        let (mut height, mut speed, mut travel, mut last) = (0.0, 0.0, 0.0, 0.0);
        let mut advance = |step: u64| {
            let step = i64::try_from(step).expect("few steps");
            let [before, after] = [step - 1, step].map(of_wall);
            let seen = speed + (1.0 - later) * before + later * after;
            let force = -own.stiffness * (height + travel) - own.damping * seen;
            let imbalance = match is_late {
                true => force - later * own.damping * dt * last,
                false => force / (1.0 + later * own.damping * dt),
            };
            let moving = if is_late { last } else { imbalance };
            last = imbalance;
            speed += moving * dt;
            height += speed * dt;
            travel += after * dt;
            imbalance
        };
        (0..=schedule.compression_steps).map(&mut advance).collect()
    }

    /// The largest imbalance after the first step, in units of its bound.
    fn closest(case: &Case, scheme: Scheme) -> f64 {
        let lag = if scheme.is_late {
            case.protocol.time_step
        } else {
            0.0
        };
        let own = of_lag(case, lag).expect("it oscillates");
        let ratios = stepped(case, scheme).into_iter().enumerate().skip(1);
        let ratios = ratios.map(|(step, imbalance)| {
            imbalance.abs() / own.bound(step as f64 * case.protocol.time_step)
        });
        ratios.fold(0.0, f64::max)
    }

    #[test]
    fn a_touch_has_the_envelope_of_the_formula() {
        for (restitution, floor_ratio) in [(PAPER_RESTITUTION, 1.0), (0.2, 3.0), (1.0, 0.3)] {
            let case = case(restitution, floor_ratio, 1e-3);
            let own = oscillator(&case);
            let damped = (floor_ratio - 0.25 * own.damping * own.damping).sqrt();
            let imbalances = stepped(&case, Scheme::NATIVE);
            for (step, imbalance) in imbalances.iter().enumerate().skip(1).take(20_000) {
                let time = step as f64 * 1e-3;
                let decay = libm::exp(-0.5 * own.damping * time);
                // −v (η cos ω_d t + (w − η²/2)/ω_d sin ω_d t) e^(−η t/2)
                let (sine, cosine) = libm::sincos(damped * time);
                let inner = (floor_ratio - 0.5 * own.damping * own.damping) / damped;
                let exact = -SPEED * (own.damping * cosine + inner * sine) * decay;
                assert!(
                    (imbalance - exact).abs() < 4e-3 * SPEED * floor_ratio,
                    "{restitution}, {floor_ratio}, {time}: {imbalance:e} for {exact:e}"
                );
                assert!(imbalance.abs() <= own.bound(time));
            }
        }
    }

    /// No imbalance exceeds its bound, and some come as close to it as the factor 1 + √w Δt allows.
    #[test]
    fn touch_and_slowing_stay_below_their_bounds() {
        for restitution in [PAPER_RESTITUTION, 0.1, 1.0] {
            for (floor_ratio, time_step) in [(1.0, 0.01), (1.0, 0.2), (4.0, 0.1), (0.2, 0.05)] {
                let mut case = case(restitution, floor_ratio, time_step);
                let plain = closest(&case, Scheme::NATIVE);
                case.protocol.shortcuts = Some(Shortcuts {
                    speed_factor: 3.0,
                    fast_until_travel: 1.5e-3,
                    stop_at_drop: 0.0,
                });
                case.validate().expect("it is valid");
                for ratio in [plain, closest(&case, Scheme::NATIVE)] {
                    let what = format!("{restitution}, {floor_ratio}, {time_step}: {ratio}");
                    assert!(ratio <= 1.0 && ratio > 0.8, "{what}");
                }
            }
        }
    }

    /// The bound must hold at all times for any code that converges, since errors of the decay rate add up over the
    /// steps.
    #[test]
    fn another_integrator_stays_below_the_bound() {
        for restitution in [PAPER_RESTITUTION, 0.1, 1.0] {
            for (floor_ratio, time_step) in [(1.0, 0.01), (1.0, 0.2), (4.0, 0.1), (0.2, 0.05)] {
                let case = case(restitution, floor_ratio, time_step);
                let schemes = [0.0, 0.5, 1.0]
                    .into_iter()
                    .flat_map(|later| [-1, 0, 1].map(|begins| (later, begins)))
                    .flat_map(|(later, begins)| {
                        [false, true].map(|is_late| Scheme {
                            later,
                            begins,
                            is_late,
                        })
                    });
                // Late forces may take more damping away than there is; nobody uses a scheme that explodes.
                let own = oscillator(&case);
                let explodes = own.damping <= own.stiffness * time_step;
                for scheme in schemes.filter(|scheme| !(scheme.is_late && explodes)) {
                    let ratio = closest(&case, scheme);
                    let what = format!("{restitution}, {floor_ratio}, {time_step}, {scheme:?}");
                    assert!(ratio <= 1.0, "{what}: {ratio}");
                    let is_close = ratio > if scheme.is_late { 0.9 } else { 0.96 };
                    assert!(time_step > 0.01 || is_close, "{what}: {ratio}");
                }
            }
        }
    }

    /// A wall that has its speed before the first step causes the same motion, smaller by η Δt.
    #[test]
    fn a_wall_that_moves_before_the_first_step_rings_less() {
        let case = case(PAPER_RESTITUTION, 1.0, 0.025);
        let damping = oscillator(&case).damping;
        let pair = [Scheme::NATIVE, Scheme::EARLY].map(|scheme| stepped(&case, scheme));
        for (native, early) in pair[0].iter().zip(&pair[1]).skip(1).take(2000) {
            let expected = native * (1.0 - damping * 0.025);
            assert!(
                (early - expected).abs() < 1e-12 * SPEED,
                "{early:e} for {expected:e}"
            );
        }
    }

    /// The lowest frequency and decay of the paper's stack, by its eigenvalues, are 0.7321 and 0.0672.
    #[test]
    fn a_standing_stack_is_no_slower_than_said() {
        let Standing { frequency, decay } = oscillator(&case(PAPER_RESTITUTION, 1.0, 0.1)).standing;
        assert!(frequency < 0.7321 && frequency > 0.6, "{frequency}");
        assert!(decay < 0.0672 && decay > 0.04, "{decay}");
    }

    #[test]
    fn what_a_touch_has_left_decays_and_soft_contacts_keep_it_longer() {
        let case = case(PAPER_RESTITUTION, 1.0, 0.1);
        let left = |law, time| {
            let convention = ContactConvention {
                law,
                ..case.convention
            };
            left_of_touch(&case.stack, &convention, 1e-3, time)
        };
        let Standing { frequency, decay } = oscillator(&case).standing;
        assert_eq!(left(Law::LINEAR, 0.0), 1e-3 / frequency);
        let ratio = left(Law::LINEAR, 10.0) / left(Law::LINEAR, 20.0);
        assert!((ratio / libm::exp(10.0 * decay) - 1.0).abs() < 1e-12);
        // Under the weight alone, Hertz contacts are softer by the square root of the overlap.
        assert!(left(Law::HERTZ, 0.0) > 1.5 * left(Law::LINEAR, 0.0));
        assert!(left(Law::HERTZ, 100.0) > 10.0 * left(Law::LINEAR, 100.0));
    }

    #[test]
    fn only_a_linear_law_after_a_gravity_ramp_makes_an_oscillator() {
        let linear = case(PAPER_RESTITUTION, 1.0, 0.1);
        let mut hertz = linear;
        hertz.convention.law = Law::HERTZ;
        assert!(of(&hertz).is_none());
        let mut between_walls = linear;
        between_walls.protocol.preparation = Preparation::SideWalls(SideWalls::paper(0.01, 0.01));
        assert!(of(&between_walls).is_none());
        let mut coarse = linear;
        coarse.convention.restitution = 1e-3;
        coarse.protocol.time_step = 0.5;
        assert!(of(&coarse).is_none());
    }
}
