//! The planned impacts of a code.

use super::extrapolate::DIVISIONS;
use crate::code::{Code, SettledCode};
use crate::model::{
    ContactConvention, ContactTest, CoulombOperand, DampingGrowth, Impact, ImpactTarget, Power,
    SlidingSpring, TangentialHistory, TangentialStiffening,
};
use crate::runs::ImpactRun;
use crate::theory::{NormalImpact, has_closed_form, normal_impact};

/// Restitution in place of 1 for codes that refuse 1. Its damping changes nothing by more than some 1e-9, a hundredth
/// of the smallest tolerance, under any law of damping.
pub const NEARLY_ELASTIC: f64 = 1.0 - 1e-9;
/// Declared restitutions of damped impacts.
const DAMPED: [f64; 2] = [0.8, 0.5];
/// Speeds of head-on impacts, in r √(k_n/m): overlaps from 0.01 to 0.25.
const SPEEDS: [f64; 2] = [0.1, 0.01];
/// Speed of approach of oblique impacts.
const OBLIQUE_SPEED: f64 = 0.02;
/// Declared restitution of damped oblique impacts.
const OBLIQUE_DAMPED: f64 = 0.8;
/// Friction so low that surfaces go on sliding.
const FRICTION: f64 = 0.01;
/// k_n/k_t: that of Mindlin's spring at Poisson's ratio 2/7.
const STIFFNESS_RATIO: f64 = 1.2;
/// A single finest step stretches an empty tangential spring to this many times the largest friction force. Surfaces
/// that slide so fast never stick, whatever happens to the spring of a contact that slides.
const SLIDING_MARGIN: f64 = 2.0;
/// Sliding speed of a contact that sticks at first, in μ κ times the speed of approach. It sticks for a hundredth of
/// the impact, which the finest steps resolve; and friction, which takes some 7 μ times the speed of approach, does
/// not stop it.
const FAST: f64 = 12.0;
/// Length of a motion, in units of the exact duration of the overlap: a contact half as stiff parts within it.
const LENGTH: f64 = 1.5;
/// Further steps, for the rows after the contact.
const FURTHER_STEPS: u64 = 8;

/// What is measured of an impact.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ImpactQuantity {
    /// The largest overlap.
    GreatestOverlap,
    /// The time for which the bodies overlap.
    Duration,
    /// Speed of separation over speed of approach.
    Restitution,
    /// Change of the tangential velocity.
    TangentialVelocity,
    /// Change of the spin.
    Spin,
}

impl ImpactQuantity {
    const HEAD_ON: [Self; 3] = [Self::GreatestOverlap, Self::Duration, Self::Restitution];
    const OBLIQUE: [Self; 2] = [Self::TangentialVelocity, Self::Spin];

    /// The word in tables.
    pub fn as_str(self) -> &'static str {
        match self {
            Self::GreatestOverlap => "greatest-overlap",
            Self::Duration => "duration",
            Self::Restitution => "restitution",
            Self::TangentialVelocity => "tangential-velocity",
            Self::Spin => "spin",
        }
    }

    /// Its unit.
    pub fn unit(self) -> &'static str {
        match self {
            Self::GreatestOverlap => "r",
            Self::Duration => "√(m/k_n)",
            Self::Restitution => "1",
            Self::TangentialVelocity => "r √(k_n/m)",
            Self::Spin => "√(k_n/m)",
        }
    }

    /// Whether friction changes it.
    pub fn is_oblique(self) -> bool {
        Self::OBLIQUE.contains(&self)
    }
}

/// Where an exact value comes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Reference {
    /// A formula, perhaps with a quadrature.
    ClosedForm,
    /// The equations of motion, integrated.
    Integrated,
    /// The native code with the same convention, at the same time steps.
    Twin,
}

impl Reference {
    /// The word in tables.
    pub fn as_str(self) -> &'static str {
        match self {
            Self::ClosedForm => "closed-form",
            Self::Integrated => "integrated",
            Self::Twin => "twin",
        }
    }
}

/// One number of one impact by one code.
#[derive(Debug, Clone, PartialEq)]
pub struct ImpactStudy {
    /// The code.
    pub code: SettledCode,
    /// The impact, under the convention of the code.
    pub impact: Impact,
    /// Its normal motion.
    pub normal: NormalImpact,
    /// What is measured.
    pub quantity: ImpactQuantity,
    /// Its runs, coarsest time step first.
    pub runs: [ImpactRun; 4],
}

impl ImpactStudy {
    /// Whether the convention declares more damping than that of [`NEARLY_ELASTIC`].
    pub fn is_damped(&self) -> bool {
        is_damped(&self.impact)
    }

    /// Returns where the exact value comes from.
    ///
    /// While the surfaces slide, the tangential force is μ |N|. A damped contact of some conventions sticks at times;
    /// then a twin is the reference.
    pub fn reference(&self) -> Reference {
        match self.quantity.is_oblique() {
            false if has_closed_form(&self.impact) => Reference::ClosedForm,
            false => Reference::Integrated,
            true if sticks_at_first(&self.impact) || may_stick_again(&self.impact) => {
                Reference::Twin
            }
            true => Reference::Integrated,
        }
    }

    /// Returns the runs of the native twin.
    pub(super) fn twin(&self) -> Vec<ImpactRun> {
        let with_convention = |run: &ImpactRun| ImpactRun {
            test: ContactTest {
                convention: self.impact.convention,
                ..run.test
            },
            ..*run
        };
        self.runs.iter().map(with_convention).collect()
    }
}

/// Plans all impacts by `code`, whose convention is `convention`.
pub fn plan_impacts(code: &SettledCode, convention: ContactConvention) -> Vec<ImpactStudy> {
    let elastic = elastic(code.name(), &convention);
    let with = |damped: &[f64]| [&[elastic], damped].concat();
    let impact = |target, restitution, approach_speed| Impact {
        target,
        convention: ContactConvention {
            restitution,
            ..convention
        },
        stiffness_ratio: STIFFNESS_RATIO,
        friction: FRICTION,
        approach_speed,
        sliding_speed: 0.0,
    };
    let mut studies = Vec::new();
    for target in ImpactTarget::ALL {
        for restitution in with(&DAMPED) {
            for speed in SPEEDS {
                let impact = impact(target, restitution, speed);
                studies.extend(studies_of(code, impact, &ImpactQuantity::HEAD_ON));
            }
        }
        for restitution in with(&[OBLIQUE_DAMPED]) {
            let impact = sliding(impact(target, restitution, OBLIQUE_SPEED));
            studies.extend(studies_of(code, impact, &ImpactQuantity::OBLIQUE));
        }
    }
    studies
}

/// Returns the restitution of an elastic impact that `code` accepts.
fn elastic(code: &Code, convention: &ContactConvention) -> f64 {
    let asked = ContactConvention {
        restitution: 1.0,
        ..*convention
    };
    match code.check_declared(&asked) {
        Ok(()) => 1.0,
        Err(_) => NEARLY_ELASTIC,
    }
}

/// Returns `impact` with surfaces that go on sliding until they part.
fn sliding(impact: Impact) -> Impact {
    let sliding_speed = match sticks_at_first(&impact) {
        true => FAST * impact.friction * impact.stiffness_ratio * impact.approach_speed,
        false => speed_without_sticking(&impact),
    };
    Impact {
        sliding_speed,
        ..impact
    }
}

/// Whether a contact sticks at first however fast its surfaces move: its spring grows from nothing, while damping has
/// pressed the bodies together from the first moment on.
fn sticks_at_first(impact: &Impact) -> bool {
    is_damped(impact) && impact.convention.coulomb_operand == CoulombOperand::Spring
}

/// Whether a contact that slides may stick again. A spring that follows a limit on spring and damping holds the limit
/// minus the damping of the last step. Where that damping has faded faster than the force of the spring, their sum is
/// below the limit.
fn may_stick_again(impact: &Impact) -> bool {
    let (convention, law) = (&impact.convention, &impact.convention.law);
    let holds_less = convention.sliding_spring == SlidingSpring::FollowsLimit
        && convention.coulomb_operand == CoulombOperand::SpringAndDamping;
    let neither_changes =
        law.power == Power::Linear && law.tangential_stiffening == TangentialStiffening::None;
    let both_change_alike =
        law.damping == DampingGrowth::Viscoelastic && law.history != TangentialHistory::Force;
    is_damped(impact) && holds_less && !(neither_changes || both_change_alike)
}

/// Whether the convention declares more damping than that of [`NEARLY_ELASTIC`].
fn is_damped(impact: &Impact) -> bool {
    impact.convention.restitution < NEARLY_ELASTIC
}

fn speed_without_sticking(impact: &Impact) -> f64 {
    let (law, normal) = (impact.law(), normal_impact(impact));
    let largest_friction = impact.friction * law.normal_stiffness * normal.greatest_overlap;
    let finest_step = time_step(&normal, DIVISIONS[DIVISIONS.len() - 1]);
    SLIDING_MARGIN * largest_friction / (law.tangential_stiffness * finest_step)
}

/// Returns the time step with which the force of a normal impact begins in the middle of a step and also ends there.
fn time_step(normal: &NormalImpact, division: u32) -> f64 {
    normal.force_duration / f64::from(division)
}

fn studies_of(
    code: &SettledCode,
    impact: Impact,
    quantities: &[ImpactQuantity],
) -> impl Iterator<Item = ImpactStudy> {
    let asked = match code.name().accepts_any_convention() {
        true => impact.convention,
        // Motions are requested under the declared convention.
        false => ContactConvention {
            restitution: impact.convention.restitution,
            ..code.name().declaration().convention
        },
    };
    let normal = normal_impact(&impact);
    let runs = DIVISIONS.map(|division| {
        let time_step = time_step(&normal, division);
        let steps = (LENGTH * normal.duration / time_step).ceil() as u64 + FURTHER_STEPS;
        ImpactRun {
            target: impact.target,
            test: impact.test(asked, time_step, steps),
        }
    });
    quantities.iter().map(move |&quantity| ImpactStudy {
        code: code.clone(),
        impact,
        normal,
        quantity,
        runs,
    })
}
