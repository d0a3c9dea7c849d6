//! The parameters of a code, measured by the micro-tests of the probe. A parameter is what the task asks for: another
//! value is a mistake, whereas a convention may be any.

use super::factor::{is_about, meanings, of_factor, of_friction};
use super::reaction::action_and_reaction;
use super::report::{Grade, Item};
use crate::code::{Code, Declaration};
use crate::model::{
    ContactArms, ContactConvention, CoulombOperand, HistoryUpdate, SlidingSpring, TensileForce,
};
use crate::runs::ProbeRecord;
use crate::series::ENOUGH_DIGITS;
use crate::study::convention::{Property, TOLERANCE, probe};

/// Relative deviation from which on numbers with few digits are another number.
const GROSS: f64 = 1e-2;
/// m g in the micro-tests, which have no gravity: no factor is mistaken for it.
const NO_WEIGHT: f64 = f64::INFINITY;

/// The properties that are parameters of the task, or follow from the way in which results are written, by the items
/// under which they are reported.
const PARAMETERS: [(&str, &[&str]); 7] = [
    ("mass", &["mass"]),
    ("normal stiffness", &["normal_stiffness"]),
    ("tangential stiffness", &["tangential_stiffness"]),
    ("damping", &["normal_damping", "tangential_damping"]),
    ("radius and torque", &["radius"]),
    ("friction", &["friction"]),
    ("force of the top wall", &["reported_force"]),
];
const MOMENTS: [&str; 2] = ["overlap_lead", "damping_velocity_lag"];
const MOMENTS_NAME: &str = "forces and positions of one moment";

/// What the micro-tests say of a code.
pub(super) struct Micro {
    properties: Vec<Property>,
    /// The digits of the motions, if they are few.
    few_digits: bool,
    reaction: Item,
}

impl Micro {
    /// Reads the answers of `code`.
    pub fn of(code: Code, record: &ProbeRecord) -> Option<Self> {
        let answered = |tests: &[_]| record.answer(tests).ok_or(());
        let digits = record
            .answers
            .iter()
            .map(|answer| answer.motion.most_digits());
        Some(Self {
            properties: probe(&code.declaration(), answered).ok()?,
            few_digits: digits.max().unwrap_or(0) < ENOUGH_DIGITS,
            reaction: action_and_reaction(record),
        })
    }

    /// Whether a property is another one than declared.
    fn deviates(&self, property: &Property) -> bool {
        let scale = if property.declared == 0.0 {
            1.0
        } else {
            property.declared.abs()
        };
        let relative = if self.few_digits { GROSS } else { TOLERANCE };
        let apart = (property.measured.value - property.declared).abs();
        apart > (relative * scale).max(property.measured.uncertainty)
    }

    /// The items on parameters, one a kind, and the one on the declared convention.
    pub fn items(&self) -> Vec<Item> {
        let parameters = PARAMETERS
            .iter()
            .map(|(name, endings)| self.item(name, endings));
        let mut items: Vec<Item> = parameters.collect();
        items.push(self.reaction.clone());
        items.push(self.item(MOMENTS_NAME, &MOMENTS));
        items.push(self.declaration());
        items
    }

    fn item(&self, name: &'static str, endings: &[&str]) -> Item {
        let own = self
            .properties
            .iter()
            .filter(|property| endings.contains(&ending(&property.name)));
        let own: Vec<&Property> = own.collect();
        let wrong: Vec<&Property> = own
            .iter()
            .copied()
            .filter(|property| self.deviates(property))
            .collect();
        if wrong.is_empty() {
            let known = own
                .iter()
                .any(|property| property.measured.value.is_finite());
            return match known {
                true => Item::passed(Grade::Consistency, name, "as asked"),
                false => {
                    Item::not_tested(Grade::Consistency, name, "the micro-tests do not show it")
                }
            };
        }
        let shown = |value: &dyn Fn(&Property) -> f64| {
            let each = wrong
                .iter()
                .map(|property| format!("{} {:.6}", property.name, value(property) + 0.0));
            each.collect::<Vec<_>>().join(", ")
        };
        let mut causes: Vec<String> = Vec::new();
        for property in &wrong {
            let own = causes_of(property);
            causes.extend(
                own.into_iter()
                    .filter(|cause| !causes.contains(cause))
                    .collect::<Vec<_>>(),
            );
        }
        if causes.is_empty() {
            causes.push(usual(name).to_owned());
        }
        Item::failed(
            Grade::Consistency,
            name,
            shown(&|property| property.declared),
            shown(&|property| property.measured.value),
            causes,
        )
    }

    /// The convention that the manifest declares, beside the measured one.
    fn declaration(&self) -> Item {
        const NAME: &str = "declared convention";
        let wrong = self
            .properties
            .iter()
            .filter(|own| is_convention(own) && self.deviates(own));
        let wrong: Vec<&Property> = wrong.collect();
        if wrong.is_empty() {
            return Item::passed(Grade::Consistency, NAME, "as measured");
        }
        let list = |value: &dyn Fn(&Property) -> f64| {
            let each = wrong
                .iter()
                .map(|own| format!("{} {:.6}", own.name, value(own) + 0.0));
            each.collect::<Vec<_>>().join(", ")
        };
        let causes = wrong
            .iter()
            .map(|own| correction(&own.name, own.measured.value))
            .collect();
        Item::failed(
            Grade::Consistency,
            NAME,
            format!("{} (declared)", list(&|own| own.declared)),
            format!("{} (measured)", list(&|own| own.measured.value)),
            causes,
        )
    }

    /// The convention as measured, in place of what `declared` says where they differ.
    pub fn convention(&self, declared: &Declaration) -> ContactConvention {
        let own = declared.convention;
        let value = |name: &str| {
            let found = self
                .properties
                .iter()
                .find(|property| property.name == name);
            found
                .filter(|property| self.deviates(property))
                .map(|property| property.measured.value)
        };
        let arms = |kind: &str, own: ContactArms| ContactArms {
            torque: value(&format!("{kind}_torque_arm")).unwrap_or(own.torque),
            kinematic: value(&format!("{kind}_kinematic_arm")).unwrap_or(own.kinematic),
        };
        let mut measured = own;
        measured.arms.pair = arms("pair", own.arms.pair);
        measured.arms.floor = arms("floor", own.arms.floor);
        let inertia = value("moment_of_inertia").unwrap_or(own.moment_of_inertia);
        measured.moment_of_inertia = inertia;
        if let Some(share) = value("floor_coulomb_damping_share") {
            let whole = CoulombOperand::SpringAndDamping;
            measured.coulomb_operand = if share > 0.5 {
                whole
            } else {
                CoulombOperand::Spring
            };
        }
        if let Some(memory) = value("floor_sliding_spring_memory") {
            let limit = SlidingSpring::FollowsLimit;
            measured.sliding_spring = if memory > 0.5 {
                SlidingSpring::Frozen
            } else {
                limit
            };
        }
        if let Some(update) = value("pair_history_update") {
            measured.history_update = match update {
                update if update > 0.5 => HistoryUpdate::Linearised,
                update if update < -0.5 => HistoryUpdate::Projected,
                _ => HistoryUpdate::Rotated,
            };
        }
        if let Some(pull) = value("pair_pull") {
            let pulls = TensileForce::MayPull;
            measured.tensile_force = if pull > 0.5 {
                pulls
            } else {
                TensileForce::NeverPulls
            };
        }
        match measured.validate() {
            Ok(()) => measured,
            Err(_) => own,
        }
    }

    /// The measured convention in one line.
    pub fn passport(&self) -> String {
        let convention = self.properties.iter().filter(|own| is_convention(own));
        let each = convention.filter(|own| own.measured.value.is_finite());
        let each = each.map(|own| format!("{} {:.6}", own.name, rounded(own.measured.value)));
        each.collect::<Vec<_>>().join(", ")
    }
}

fn rounded(value: f64) -> f64 {
    (value * 1e6).round() / 1e6 + 0.0
}

/// The name of a property without the kind of contact.
fn ending(name: &str) -> &str {
    let kinds = ["pair_", "floor_", "wall_"];
    kinds
        .into_iter()
        .find_map(|kind| name.strip_prefix(kind))
        .unwrap_or(name)
}

fn is_convention(property: &Property) -> bool {
    let ending = ending(&property.name);
    let mut parameters = PARAMETERS.iter().flat_map(|(_, endings)| *endings);
    !MOMENTS.contains(&ending) && !parameters.any(|own| *own == ending)
}

/// What fits a parameter that is not as asked.
fn causes_of(property: &Property) -> Vec<String> {
    let (found, asked) = (property.measured.value, property.declared);
    let named = |candidates: &[(f64, &str)]| {
        let candidates = candidates
            .iter()
            .map(|(value, meaning)| (*value, (*meaning).to_owned()));
        meanings(found, &candidates.collect::<Vec<_>>())
    };
    let is_none = found.abs() < 1e-9;
    let texts = match (property.name.as_str(), ending(&property.name)) {
        (_, "radius") if is_none => {
            vec!["there is no torque: the tangential force acts at the centre".to_owned()]
        }
        (_, "reported_force") if is_none => {
            vec!["it is 0: never computed, or written before it is".to_owned()]
        }
        ("wall_friction", _) => vec![format!(
            "the top wall has a friction of {found:.6}, and must have none"
        )],
        (_, "friction") => of_friction(found, asked, asked),
        (_, "radius") => named(&[
            (0.5, "1/2: a diameter of 1; the radius is 1"),
            (2.0, "2: the diameter in place of the radius"),
            (
                -1.0,
                "the torque has the wrong sign: on both bodies it is minus radius times the force along (-n_y, n_x)",
            ),
        ]),
        (_, "reported_force") => named(&[
            (-1.0, "its sign: it counts positive in compression"),
            (2.0, "it counts twice"),
        ]),
        (_, "overlap_lead") => named(&[
            (
                -1.0,
                "the force of a row is that of the step before: it is written before it is computed anew, or positions \
                    have moved on before they are written",
            ),
            (
                1.0,
                "the force of a row is that of the step after: positions are written before they move, forces after",
            ),
        ]),
        (_, "normal_damping" | "tangential_damping") => damping(found, asked),
        (_, "tangential_stiffness") => {
            let mut texts = of_factor(found / asked, NO_WEIGHT);
            // In the micro-tests k_n/k_t = 1/k_t, since k_n = 1.
            if is_about(found, 1.0) {
                texts.push("k_n: the normal stiffness serves for both".to_owned());
            }
            if is_about(found, 1.0 / asked) {
                texts.push("1/k_t: the ratio is turned round".to_owned());
            }
            texts
        }
        (_, "mass" | "normal_stiffness") => of_factor(found / asked, NO_WEIGHT),
        _ => Vec::new(),
    };
    let name = &property.name;
    texts
        .into_iter()
        .map(|text| format!("{name}: {text}"))
        .collect()
}

fn damping(found: f64, asked: f64) -> Vec<String> {
    let factor = found / asked;
    if factor.abs() < 1e-6 {
        return vec!["there is no damping".to_owned()];
    }
    let own = |value: f64, meaning: &str| (value, meaning.to_owned());
    let candidates = [
        own(-1.0, "its sign: it must oppose the motion"),
        own(
            2.0,
            "twice: 2 sqrt(k m) and a ratio, where the coefficient itself is given, or both bodies count",
        ),
        own(
            0.5,
            "half: two equal dashpots in series, or the reduced mass m/2 counts, or one body alone",
        ),
        own(
            asked,
            "its square: the given coefficient is multiplied by itself",
        ),
        own(
            2f64.sqrt(),
            "sqrt 2: the mass in its place is twice the reduced one",
        ),
        own(
            0.5f64.sqrt(),
            "1/sqrt 2: the reduced mass m/2 in place of m; the coefficient is given, not the ratio",
        ),
    ];
    meanings(factor, &candidates)
}

/// How the manifest would say what was measured.
fn correction(name: &str, value: f64) -> String {
    let value = rounded(value);
    let (kind, ending) = match name.split_once('_') {
        Some((kind @ ("pair" | "floor"), ending)) => (kind, ending),
        _ => ("", name),
    };
    let word = |words: [(f64, &'static str); 3]| {
        let nearest = words
            .into_iter()
            .min_by(|left, right| (left.0 - value).abs().total_cmp(&(right.0 - value).abs()));
        nearest.map_or("", |(_, word)| word)
    };
    let line = match ending {
        "torque_arm" | "kinematic_arm" => format!("{kind}.{ending} = {value}"),
        "damping_arm" => {
            return format!(
                "the damping moves at another radius (arm {value}) than the spring: {name} has no key"
            );
        }
        "moment_of_inertia" => {
            format!("moment_of_inertia = {value} (1/2 is a solid cylinder, 2/5 a sphere)")
        }
        "velocity_lag" => {
            format!("velocity_lag = {value} in [integration] (1/2: leapfrog, 0: velocity Verlet)")
        }
        "coulomb_damping_share" => {
            format!(
                "coulomb_operand = \"{}\"",
                word([(0.0, "spring"), (1.0, "spring-and-damping"), (1.0, "")])
            )
        }
        "sliding_spring_memory" => {
            format!(
                "sliding_spring = \"{}\"",
                word([(0.0, "follows-limit"), (1.0, "frozen"), (1.0, "")])
            )
        }
        "history_update" => {
            format!(
                "history_update = \"{}\"",
                word([(0.0, "rotated"), (-1.0, "projected"), (1.0, "linearised")])
            )
        }
        "pull" => format!(
            "tensile_force = \"{}\"",
            word([(0.0, "never-pulls"), (1.0, "may-pull"), (1.0, "")])
        ),
        _ => {
            return format!(
                "{name} is {value}, for which the manifest has no key: the law is another one"
            );
        }
    };
    format!(
        "the code has another convention than its manifest says; in [convention] of code.toml: {line}"
    )
}

fn usual(name: &str) -> &'static str {
    match name {
        "mass" => {
            "usual causes: density times volume in place of mass 1; a force that is written, but not applied"
        }
        "normal stiffness" => {
            "usual causes: a modulus in place of a stiffness; two materials in series; Hertz in place of Hooke"
        }
        "tangential stiffness" => {
            "usual causes: the ratio k_n/k_t turned round; two materials in series"
        }
        "damping" => {
            "usual causes: a damping ratio or a restitution in place of the coefficient; global damping besides"
        }
        "radius and torque" => {
            "usual causes: a diameter in place of the radius; a torque with the wrong sign"
        }
        "friction" => "usual causes: an angle in place of the coefficient; a mean of two materials",
        "force of the top wall" => {
            "usual causes: its sign; the sum of several walls; a force of another step"
        }
        MOMENTS_NAME => {
            "usual causes: rows written after the positions moved, with the forces of before"
        }
        _ => "",
    }
}
