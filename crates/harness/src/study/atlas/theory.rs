//! What the exact theory says about the conventions of an atlas.

use super::history::{Atlas, NamedPassport};
use crate::code::ConventionKey;
use crate::model::{Arms, ContactConvention, Problem, Stack};
use crate::study::convention::PassportFile;
use crate::theory::quasistatic_limit;

/// Number of frictions at which curves are computed.
const FRICTIONS: usize = 81;
/// The stiffness of the curves, k_n r/(m g).
pub const SPREAD_STIFFNESS: f64 = 1e2;
/// Arms are rounded to the inverse of this, so that rounding in the codes forms no groups of its own.
const ROUNDING: f64 = 1e6;

/// The yield force of the paper's stack under the arms of some codes.
#[derive(Debug, Clone, PartialEq)]
pub struct Spread {
    /// The arms of pairs and of the floor: torque and kinematic.
    pub arms: [f64; 4],
    /// The program and style of each code that has them.
    pub codes: Vec<String>,
    /// Floor friction, and the change of the yield force in percent of F + 3 under the paper's arms.
    pub points: Vec<(f64, Option<f64>)>,
}

/// The yield force of one stack over one arm, all others being the paper's.
#[derive(Debug, Clone, PartialEq)]
pub struct ArmCurve {
    /// The stack.
    pub stack: Stack,
    /// The arm, and the change of the yield force in percent.
    pub points: Vec<(f64, f64)>,
    /// Arm and change at the arms of codes.
    pub codes: Vec<(f64, f64)>,
}

/// A stiffness k overlap^exponent, as a passport has it.
#[derive(Debug, Clone, PartialEq)]
pub struct StiffnessLaw {
    /// The version of the program.
    pub version: String,
    /// The stiffness at an overlap of r, in k_n.
    pub stiffness: f64,
    /// The exponent.
    pub exponent: f64,
}

impl StiffnessLaw {
    /// Returns the law of the stiffness `name`, such as `floor_tangential_stiffness`. A normal force K overlap^p has
    /// the stiffness p K overlap^(p − 1).
    pub fn of(passport: &PassportFile, name: &str) -> Option<Self> {
        let number = |name: &str| passport.property(name).map(|row| row.measured);
        let coefficient = number(name)??;
        let power = name
            .strip_suffix("_stiffness")
            .and_then(|kind| number(&format!("{kind}_force_exponent")));
        let (stiffness, exponent) = match power {
            Some(power) => (power? * coefficient, power? - 1.0),
            None => (
                coefficient,
                number(&format!("{name}_exponent")).unwrap_or(Some(0.0))?,
            ),
        };
        Some(Self {
            version: passport.program.version.clone(),
            stiffness,
            exponent,
        })
    }

    /// Returns the stiffness at an `overlap` in r.
    pub fn at(&self, overlap: f64) -> f64 {
        self.stiffness * libm::pow(overlap, self.exponent)
    }
}

impl NamedPassport {
    /// Returns all four arms; `None` where one is unknown.
    pub fn arms(&self) -> Option<Arms> {
        let mut arms = Arms::PAPER;
        for key in ConventionKey::ARMS {
            let (value, _) = self.passport.key(key.as_str())?.number()?;
            key.set_arm(&mut arms, (value * ROUNDING).round() / ROUNDING + 0.0);
        }
        Some(arms)
    }

    /// Whether its contacts are linear springs.
    pub fn is_linear(&self) -> bool {
        let exponent = self.passport.property("pair_normal_force_exponent");
        exponent.is_none()
    }
}

/// Returns the change of the yield force of `stack` under `arms`, in percent of F + 3 under the paper's; `None` if it
/// does not yield, or if a passport has an arm out of range.
fn change(stack: &Stack, arms: Arms) -> Option<f64> {
    let force = |arms| {
        let problem = Problem::new(*stack, ContactConvention::with_arms(arms)).ok()?;
        quasistatic_limit(&problem).yield_force
    };
    let (paper, own) = force(Arms::PAPER).zip(force(arms))?;
    Some(100.0 * (own - paper) / stack.floor_load(paper))
}

impl Atlas {
    /// Computes one stiffness under the arms of all linear codes. Codes with the same arms form one group; the
    /// paper's arms come first.
    pub fn spread(&self) -> Vec<Spread> {
        let mut spread: Vec<Spread> = Vec::new();
        for own in self.passports.iter().filter(|own| own.is_linear()) {
            let Some(arms) = own.arms() else { continue };
            let numbers = ConventionKey::ARMS.map(|key| key.arm(&arms).unwrap_or_default());
            let name = format!("{}, {}", own.passport.software, own.passport.style);
            match spread.iter_mut().find(|group| group.arms == numbers) {
                Some(group) if group.codes.contains(&name) => {}
                Some(group) => group.codes.push(name),
                None => spread.push(Spread {
                    arms: numbers,
                    codes: vec![name],
                    points: curve(arms),
                }),
            }
        }
        spread.sort_by(|one, other| {
            let order = |own: &Spread| own.arms.map(|arm| -arm);
            order(one)
                .partial_cmp(&order(other))
                .unwrap_or(std::cmp::Ordering::Equal)
        });
        spread
    }

    /// Computes what the arm `key` alone does to the yield force of three stacks, with the codes on the curves.
    pub fn arm_curves(&self, key: ConventionKey) -> Vec<ArmCurve> {
        let with = |value: f64| {
            let mut arms = Arms::PAPER;
            key.set_arm(&mut arms, value);
            arms
        };
        let mut own: Vec<f64> = self
            .passports
            .iter()
            .filter_map(|own| key.arm(&own.arms()?))
            .collect();
        own.sort_by(f64::total_cmp);
        own.dedup();
        let stacks = [(0.2, 1e2), (0.3, 1e2), (0.3, 1e3)];
        let curves = stacks.map(|(friction, stiffness)| {
            let stack = Stack::paper(friction, stiffness);
            let at = |arm: f64| Some((arm, change(&stack, with(arm))?));
            ArmCurve {
                points: (0..=40)
                    .filter_map(|step| at(-1.0 + f64::from(step) / 40.0))
                    .collect(),
                codes: own.iter().filter_map(|&arm| at(arm)).collect(),
                stack,
            }
        });
        curves.into()
    }
}

fn curve(arms: Arms) -> Vec<(f64, Option<f64>)> {
    let frictions = (0..FRICTIONS).map(|step| 0.1 + 0.4 * step as f64 / (FRICTIONS - 1) as f64);
    let points = frictions.map(|mu| (mu, change(&Stack::paper(mu, SPREAD_STIFFNESS), arms)));
    points.collect()
}
