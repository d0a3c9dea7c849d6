//! A property of a code, as measured and as declared, and the verdict on it.

use super::experiments::ContactKind;
use super::regression::Measured;
use crate::code::{Code, ConventionKey};
use crate::study::Verdict;

/// Largest deviation of an external code that agrees, relative to the declared value (to 1 where that is 0): a tenth of
/// the largest tolerance for yield forces, and a thousand times the largest deviation of the known codes.
pub const TOLERANCE: f64 = 1e-6;

/// The same for the native code, which deviates from its declaration by rounding alone.
pub const NATIVE_TOLERANCE: f64 = 1e-9;

/// Largest distance of a value at vanishing time step from that of the rule that it shows: a quarter of the distance of
/// rules.
pub const NEAR_A_RULE: f64 = 0.25;

/// Largest uncertainty of a value at vanishing time step, relative to the declared value. No two codes are known that mean
/// different things and are closer, and what is left open is no more than the uncertainty that is stated.
const EXTRAPOLATED: f64 = 1e-3;
/// The same of a damping, on which no yield force depends: stacks come to rest a hundredth earlier or later.
const EXTRAPOLATED_DAMPING: f64 = 1e-2;

/// Largest uncertainty of a value that decides between rules, whose values are 1 apart.
const CLEAR: f64 = 1e-2;

/// Suffix of the name of the exponent with which a stiffness grows with the overlap.
pub const EXPONENT: &str = "_stiffness_exponent";

/// Name of that exponent of the tangential stiffness, without the kind of contact.
pub const TANGENTIAL_EXPONENT: &str = "tangential_stiffness_exponent";

/// Name of the exponent of the normal force, without the kind of contact.
pub const FORCE_EXPONENT: &str = "normal_force_exponent";

/// Names of the exponents with which damping grows with the overlap, without the kind of contact.
pub const NORMAL_DAMPING_EXPONENT: &str = "normal_damping_exponent";
pub const TANGENTIAL_DAMPING_EXPONENT: &str = "tangential_damping_exponent";

/// Names of the times to which the overlap and the velocities in the normal force belong, without the kind of contact.
pub const OVERLAP_LEAD: &str = "overlap_lead";
pub const DAMPING_VELOCITY_LAG: &str = "damping_velocity_lag";

/// Name of the steps by which reported velocities lag behind reported positions.
pub const VELOCITY_LAG: &str = "velocity_lag";

/// Name of the steps by which the forces that move the bodies lag behind the positions.
pub const FORCE_LAG: &str = "force_lag";

/// Name of the share by which bodies are damped in proportion to the force on them.
pub const LOCAL_DAMPING: &str = "local_damping";

/// Name of the couple that resists rolling, over the normal force, without the kind of contact.
pub const ROLLING_COUPLE: &str = "rolling_couple";

/// Name of the share of the normal damping in the normal force that Coulomb's limit counts, without the kind of contact.
pub const LIMIT_DAMPING_SHARE: &str = "limit_damping_share";

/// Name of the stiffness of the tangential spring, without the kind of contact.
pub const TANGENTIAL_STIFFNESS: &str = "tangential_stiffness";

/// Name of what a contact does to its spring when it turns, without the kind of contact.
pub const HISTORY_UPDATE: &str = "history_update";

/// Names of the radius at vanishing overlap from the torque, and from the growth of the spring, without the kind of
/// contact.
pub const RADIUS: &str = "radius";
pub const SPRING_RADIUS: &str = "spring_radius";

/// Names of the work of closed cycles, without the kind of contact.
pub const SHEARED_FIRST: &str = "cycle_work_sheared_first";
pub const PRESSED_FIRST: &str = "cycle_work_pressed_first";

/// Suffix of the name of the coefficient c of a surface that moves by d + c d³ when it turns by d in a step.
pub const CUBED_TURN: &str = "cubed_turn";
/// Turn in a step up to which such a coefficient must be known well enough; larger than those in stacks.
const LARGEST_TURN: f64 = 1e-2;

/// A property of one code, measured.
#[derive(Debug, Clone, PartialEq)]
pub struct Finding {
    /// The code.
    pub code: Code,
    /// Version of the code.
    pub version: String,
    /// Name of the property.
    pub property: String,
    /// The key of the manifest that it belongs to, if there is one.
    pub key: Option<ConventionKey>,
    /// Measured value; absent if the measurement failed.
    pub measured: Option<f64>,
    /// Three standard errors; absent with the measured value.
    pub uncertainty: Option<f64>,
    /// Declared value; absent where the manifest leaves it out and the measured one is used.
    pub declared: Option<f64>,
    /// What it is at the time step of the micro-tests, if the measured value is that at vanishing step.
    pub step_effect: Option<StepEffect>,
    /// Whether the two agree, or, without a declaration, whether the measured value can be used.
    pub verdict: Verdict,
}

/// How a property depends on the time step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StepEffect {
    /// Its value at the time step of the micro-tests.
    pub at_step: f64,
    /// The uncertainty of that value, from deviations that the law leaves there.
    pub uncertainty: f64,
    /// The power of the step with which it approaches the value at vanishing step.
    pub order: u32,
}

impl Finding {
    /// Says that a stiffness meant to be constant changes with the overlap; `None` if this is another finding.
    pub fn growth(&self) -> Option<String> {
        let stiffness = self.property.strip_suffix(EXPONENT)?;
        self.declared.filter(|declared| *declared == 0.0)?;
        let (kind, direction) = stiffness.split_once('_')?;
        let k = if direction == "normal" { "k_n" } else { "k_t" };
        let exponent = self.measured?;
        let changes = if exponent < 0.0 { "falls" } else { "grows" };
        Some(format!(
            "{kind} {k} {changes} with the overlap (like overlap^{exponent:.2})"
        ))
    }

    /// Names what the code has, or lacks, beside the model; `None` if this finding does not show such a thing.
    pub fn other_model(&self) -> Option<String> {
        let measured = self.measured.filter(|_| self.verdict == Verdict::Differs)?;
        let name = self.property.as_str();
        if name == LOCAL_DAMPING {
            return Some(format!(
                "the bodies are damped in proportion to the force on them (local damping, as Cundall's) with the coefficient \
                 {measured:.6}, which the model does not have"
            ));
        }
        let of_kind = |end: &str| Some(name.strip_suffix(end)?.trim_end_matches('_'));
        if let Some(kind) = of_kind(ROLLING_COUPLE) {
            return Some(format!(
                "{kind}: a couple of {measured:.2e} r times the normal force resists rolling, which the model does not have"
            ));
        }
        if let Some(kind) = of_kind(LIMIT_DAMPING_SHARE) {
            return Some(format!(
                "{kind}: Coulomb's limit is μ times the spring's part of the normal force alone; in the model it counts the \
                 damping, too"
            ));
        }
        let kind = of_kind(TANGENTIAL_STIFFNESS).filter(|_| measured == 0.0)?;
        Some(format!(
            "{kind}: there is no tangential spring; the tangential force only opposes the sliding, and gives nothing back once the \
             surfaces come to rest"
        ))
    }

    /// Says that a contact gives back more energy than it was given; `None` if this is another finding.
    pub fn energy_made(&self) -> Option<String> {
        let name = self.property.as_str();
        let (kind, order) = [
            (SHEARED_FIRST, "sheared, pressed, sheared back and released"),
            (PRESSED_FIRST, "pressed, sheared, released and sheared back"),
        ]
        .into_iter()
        .find_map(|(end, order)| Some((name.strip_suffix(end)?, order)))?;
        let (work, open) = self.measured.zip(self.uncertainty)?;
        (work < -open).then(|| {
            let kind = kind.trim_end_matches('_');
            let share = -100.0 * work;
            format!(
                "{kind}: a contact that is {order} gives back more energy than it was given, {share:.1} % of what its spring holds"
            )
        })
    }

    /// Says why the property is unknown, if the reason is known.
    pub fn unknown_because(&self) -> Option<&'static str> {
        let of_memory = self.key == Some(ConventionKey::SlidingSpring) && self.measured.is_none();
        of_memory.then_some(
            "in its micro-test the contact slides to the end, or not at all, or what Coulomb's limit is compared with is not known; \
             the yield force does not depend on it",
        )
    }

    /// Says how the property, or the motion of a surface, depends on the time step; `None` if it does not.
    pub fn time_step_effect(&self) -> Option<String> {
        let measured = self.measured?;
        let name = &self.property;
        if let Some(effect) = self.step_effect {
            let StepEffect {
                at_step,
                uncertainty,
                order,
            } = effect;
            let (kind, time) = name.split_once('_').unwrap_or(("", name));
            return Some(match time {
                _ if name == FORCE_LAG => format!(
                    "the forces that move the bodies are those of {} the positions, an error of first order in the time step",
                    steps_away(measured, ["before", "after"])
                ),
                OVERLAP_LEAD if self.declared.is_none() => format!(
                    "{kind}: the normal force takes the overlap {} the positions, an error of first order in the time step",
                    steps_away(measured, ["after", "before"])
                ),
                // Velocities of the moment of the positions have no error of first order.
                DAMPING_VELOCITY_LAG if self.declared.is_none() && measured.abs() < SAME_MOMENT => {
                    return None;
                }
                DAMPING_VELOCITY_LAG if self.declared.is_none() => format!(
                    "{kind}: the damping of the normal force takes velocities {} the positions (half a step is right), an \
                     error of first order in the time step",
                    steps_away(measured, ["before", "after"])
                ),
                _ if !at_step.is_finite() => format!(
                    "{name} is not known with the time step of the micro-tests, and {measured:.6} with a vanishing one"
                ),
                _ if (at_step - measured).abs() < uncertainty => format!(
                    "{name} is known to {uncertainty:.0e} with the time step of the micro-tests and to be {measured:.6} with a \
                     vanishing one"
                ),
                _ => format!(
                    "{name} is {at_step:.6} with the time step of the micro-tests and {measured:.6} with a vanishing one \
                     (order {order})"
                ),
            });
        }
        let kind = name.strip_suffix(CUBED_TURN)?.trim_end_matches('_');
        let sign = if measured < 0.0 { '-' } else { '+' };
        Some(format!(
            "{kind}: a surface that turns by d in a step moves by d {sign} {:.4} d^3",
            measured.abs()
        ))
    }
}

/// A lag that is none, in steps.
const SAME_MOMENT: f64 = 1e-2;

/// Says in one line how the time step changes some `findings`: those that change most, and how many others do.
pub fn step_effects<'a>(findings: impl Iterator<Item = &'a Finding>) -> Option<String> {
    let size = |own: &Finding| {
        let StepEffect {
            at_step,
            uncertainty,
            ..
        } = own.step_effect?;
        let change = (at_step - own.measured?).abs().max(uncertainty);
        let scale = own.declared.filter(|declared| *declared != 0.0);
        Some(change / scale.unwrap_or(1.0).abs())
    };
    let sized = findings.filter_map(|own| Some((size(own)?, own)));
    // Times in units of the step are the cause of other changes.
    let (mut times, mut others): (Vec<_>, Vec<_>) =
        sized.partition(|(_, own)| own.declared.is_none() && own.key.is_none());
    times.dedup_by_key(|(_, own)| own.property.split_once('_').map(|(_, name)| name));
    others.sort_by(|(one, _), (other, _)| other.total_cmp(one));
    let further = others.len().saturating_sub(1);
    let told = times.into_iter().chain(others.into_iter().take(1));
    let mut told: Vec<String> = told.filter_map(|(_, own)| own.time_step_effect()).collect();
    match (told.last_mut(), further) {
        (None, _) => return None,
        (Some(_), 0) => (),
        (Some(last), further) => {
            last.push_str(&format!(", and {further} more change with the step"))
        }
    }
    Some(told.join("; "))
}

/// Says how far away a number of `steps` is, with the word for either direction.
fn steps_away(steps: f64, [forward, backward]: [&str; 2]) -> String {
    let direction = if steps < 0.0 { backward } else { forward };
    format!("{:.3} steps {direction}", steps.abs())
}

/// A property as measured and as declared.
#[derive(Debug, Clone, PartialEq)]
pub struct Property {
    /// Name, which begins with the kind of contact if it belongs to one.
    pub name: String,
    /// As measured.
    pub measured: Measured,
    /// As declared; absent where the manifest leaves it out.
    pub declared: Option<f64>,
    /// How it depends on the time step, if the measured value is that at vanishing step.
    pub step_effect: Option<StepEffect>,
    /// Whether it was measured with several time steps.
    pub is_extrapolated: bool,
}

impl Property {
    /// A property of the whole code.
    pub fn new(name: &str, measured: Measured, declared: f64) -> Self {
        Self {
            name: name.to_owned(),
            measured,
            declared: Some(declared),
            step_effect: None,
            is_extrapolated: false,
        }
    }

    /// A property of the contacts at `kind`.
    pub fn at(kind: ContactKind, name: &str, measured: Measured, declared: f64) -> Self {
        Self::new(&format!("{}_{name}", kind.as_str()), measured, declared)
    }

    /// The key of the manifest that it belongs to, if there is one. The arm of the damping belongs to the kinematic
    /// arm, that of the surface velocity.
    pub fn key(&self) -> Option<ConventionKey> {
        Some(match self.name.as_str() {
            "pair_torque_arm" => ConventionKey::PairTorqueArm,
            "pair_kinematic_arm" | "pair_damping_arm" => ConventionKey::PairKinematicArm,
            "floor_torque_arm" => ConventionKey::FloorTorqueArm,
            "floor_kinematic_arm" | "floor_damping_arm" => ConventionKey::FloorKinematicArm,
            "pair_history_update" | "pair_spring_left_behind" => ConventionKey::HistoryUpdate,
            "moment_of_inertia" => ConventionKey::MomentOfInertia,
            "velocity_lag" => ConventionKey::VelocityLag,
            name if name.ends_with("_coulomb_damping_share") => ConventionKey::CoulombOperand,
            name if name.ends_with("_sliding_spring_memory") => ConventionKey::SlidingSpring,
            name if name.ends_with("_pull") => ConventionKey::TensileForce,
            _ => return None,
        })
    }

    /// The property, without a declared value if its key is among those `left_out`.
    pub fn unless_left_out(mut self, left_out: &[ConventionKey]) -> Self {
        if self.key().is_some_and(|key| left_out.contains(&key)) {
            self.declared = None;
        }
        self
    }

    /// Whether the measured value differs from the declared one.
    pub fn differs(&self) -> bool {
        let error = self.declared.map(|own| self.measured.value - own);
        error
            .is_some_and(|error| error.abs() > self.measured.uncertainty + TOLERANCE * self.scale())
    }

    /// Whether the measured value is the declared one and known as well as an external code is held to.
    pub fn agrees(&self) -> bool {
        let Measured { value, uncertainty } = self.measured;
        let allowed = TOLERANCE * self.scale();
        let is_declared = |declared: f64| (value - declared).abs() <= allowed;
        self.declared.is_some_and(is_declared) && uncertainty <= allowed
    }

    /// What tolerances are relative to: the declared value, or 1 where that is 0.
    pub fn scale(&self) -> f64 {
        match self.declared.unwrap_or_default() {
            _ if self.name.ends_with(CUBED_TURN) => (LARGEST_TURN * LARGEST_TURN).recip(),
            0.0 => 1.0,
            declared => declared.abs(),
        }
    }

    /// Whether it is a time in units of the step to which positions or velocities in a force belong.
    pub fn is_time_in_steps(&self) -> bool {
        [OVERLAP_LEAD, DAMPING_VELOCITY_LAG]
            .iter()
            .any(|end| self.name.ends_with(end))
    }

    /// Whether its value shows which of a few rules a code follows.
    pub fn shows_rule(&self) -> bool {
        use ConventionKey::{CoulombOperand, HistoryUpdate, SlidingSpring, TensileForce};
        let rules = [CoulombOperand, SlidingSpring, HistoryUpdate, TensileForce];
        self.key().is_some_and(|key| rules.contains(&key))
    }

    /// Whether it is a coefficient of the tangential law.
    pub fn is_tangential(&self) -> bool {
        let mut ends = ["_tangential_stiffness", "_tangential_damping"].into_iter();
        ends.any(|end| self.name.ends_with(end))
    }

    /// Whether other errors of first order in the time step hide it: what a contact does to its spring when it turns,
    /// whose sum over a motion is as small, and what a spring remembers of a slide, which begins and ends with a step.
    /// The yield force depends on neither.
    pub fn is_hidden_by_errors(&self) -> bool {
        self.name.ends_with(HISTORY_UPDATE) || self.key() == Some(ConventionKey::SlidingSpring)
    }

    /// Judges the property of `code`.
    pub fn judge(self, code: &Code, version: &str) -> Finding {
        let scale = self.scale();
        let relative = match code.is_native() {
            true => NATIVE_TOLERANCE,
            false => TOLERANCE,
        };
        let Measured { value, uncertainty } = self.measured;
        let known = value.is_finite() && uncertainty.is_finite();
        // What is known at vanishing step alone is known less well.
        let allowed = match self.is_extrapolated {
            true if self.shows_rule() => uncertainty.clamp(relative * scale, NEAR_A_RULE),
            true if self.name.ends_with("_damping") => {
                uncertainty.clamp(relative * scale, EXTRAPOLATED_DAMPING * scale)
            }
            true => uncertainty.clamp(relative * scale, EXTRAPOLATED * scale),
            false => relative * scale,
        };
        let enough = match self.shows_rule() || self.is_time_in_steps() {
            true if self.is_extrapolated && self.shows_rule() => NEAR_A_RULE,
            true => CLEAR,
            false => allowed,
        };
        Finding {
            code: code.clone(),
            version: version.to_owned(),
            key: self.key(),
            property: self.name,
            measured: known.then_some(value),
            uncertainty: known.then_some(uncertainty),
            declared: self.declared,
            step_effect: self.step_effect,
            verdict: match self.declared {
                Some(declared) => Verdict::of(value - declared, uncertainty, allowed),
                None if known => Verdict::of(0.0, uncertainty, enough),
                None => Verdict::Inconclusive,
            },
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_small_declared_value_has_a_tolerance_of_its_own() {
        let verdict = |measured: f64, declared: f64| {
            let property = Property::new("damping", Measured::new(measured, 0.0), declared);
            property.judge(&Code::named("yade").unwrap(), "").verdict
        };
        assert_eq!(verdict(0.067 * (1.0 + 0.9e-6), 0.067), Verdict::Agrees);
        assert_eq!(verdict(0.067 * (1.0 + 1.1e-6), 0.067), Verdict::Differs);
        assert_eq!(verdict(0.9e-6, 0.0), Verdict::Agrees);
        assert_eq!(verdict(1.1e-6, 0.0), Verdict::Differs);
    }
}
