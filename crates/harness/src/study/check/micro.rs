//! The parameters of a code, measured by the micro-tests of the probe. The task prescribes parameters, so another
//! value is a mistake; a convention is the code's own choice.

use super::factor::{is_about, of_friction};
use super::invariances::Elsewhere;
use super::reaction::action_and_reaction;
use super::report::{Grade, Item, Outcome};
use super::table::meanings;
use crate::code::{Code, ConventionKey};
use crate::model::ContactConvention;
use crate::runs::{Answer, ProbeRecord};
use crate::study::convention::{
    DAMPING_VELOCITY_LAG, FORCE_LAG, Finding, Findings, LIMIT_DAMPING_SHARE, NO_CONTACT,
    OVERLAP_LEAD, TOLERANCE, forces_are_late, probe, read_probe, step_effects,
};

/// Largest relative deviation of numbers that have few digits.
const GROSS: f64 = 1e-2;
/// Largest number of causes of one item.
const MOST_CAUSES: usize = 3;

/// Items with the endings of their properties: the parameters of the task, and the way in which results are written.
const PARAMETERS: [(&str, &[&str]); 7] = [
    ("mass", &["mass"]),
    ("normal stiffness", &["normal_stiffness"]),
    ("tangential stiffness", &["tangential_stiffness"]),
    ("damping", &["normal_damping", "tangential_damping"]),
    ("radius and torque", &["radius", "spring_radius"]),
    ("friction", &["friction", LIMIT_DAMPING_SHARE]),
    ("force of the top wall", &["reported_force"]),
];
const MOMENTS: [&str; 3] = [OVERLAP_LEAD, DAMPING_VELOCITY_LAG, FORCE_LAG];
const MOMENTS_NAME: &str = "forces and positions of one moment";

/// The item on the declared convention.
pub(super) const DECLARATION: &str = "declared convention";

/// Whether `item` says of parameters that they are as asked at vanishing time step alone.
pub(super) fn is_step_effect(item: &Item) -> bool {
    let mut names = PARAMETERS.iter().map(|(name, _)| *name);
    item.outcome == Outcome::Remark
        && (item.name == MOMENTS_NAME || names.any(|own| own == item.name))
}

/// What the micro-tests show of a code.
pub(super) struct Micro {
    pub findings: Findings,
    pub answers: Vec<Answer>,
    reaction: Item,
    elsewhere: Option<Item>,
    /// The motions in which contacts come and go.
    pub others: Vec<Answer>,
}

impl Micro {
    /// Reads the answers of `code`; `None` if they do not answer the present micro-tests.
    pub fn of(code: &Code, record: ProbeRecord) -> Option<Self> {
        let reaction = action_and_reaction(&record);
        let mut first = Vec::new();
        let asked = probe(&code.declaration(), |tests| {
            first.extend_from_slice(tests);
            record.answer(tests).ok_or(())
        });
        asked.ok()?;
        // Micro-tests in space have their own equations, in the probe, and shorter steps show nothing new.
        let is_read =
            |answer: &&Answer| answer.test.space.is_none() && first.contains(&answer.test);
        let answers = record.answers.iter().filter(is_read);
        let answers = answers.cloned().collect();
        let findings = read_probe(code, record).ok()?;
        Some(Self {
            findings,
            answers,
            reaction,
            elsewhere: None,
            others: Vec::new(),
        })
    }

    /// The same with what the code does in other places.
    pub fn with(self, seen: Elsewhere) -> Self {
        Self {
            elsewhere: Some(seen.item),
            others: seen.answers,
            ..self
        }
    }

    /// Whether motions do not look the same elsewhere.
    pub fn differs_elsewhere(&self) -> bool {
        let item = self.elsewhere.as_ref();
        item.is_some_and(|item| item.outcome == Outcome::Failed)
    }

    /// Whether the forces that move the bodies are late.
    pub fn forces_are_late(&self) -> bool {
        forces_are_late(&self.findings)
    }

    /// Whether the code is as asked at vanishing time step alone.
    pub fn depends_on_step(&self) -> bool {
        let items = self.items();
        let fails = items.iter().any(|item| item.outcome == Outcome::Failed);
        !fails && items.iter().any(is_step_effect)
    }

    /// Whether a property deviates from its declaration.
    fn deviates(&self, own: &Finding) -> bool {
        let (Some(found), Some(declared)) = (own.measured, own.declared) else {
            return false;
        };
        let scale = if declared == 0.0 { 1.0 } else { declared.abs() };
        let relative = match self.findings.few_digits() {
            Some(_) => GROSS,
            None => TOLERANCE,
        };
        (found - declared).abs() > (relative * scale).max(own.uncertainty.unwrap_or(0.0))
    }

    /// Returns the items on parameters, on action and reaction, on forces and positions of one moment, and on the
    /// declared convention.
    pub fn items(&self) -> Vec<Item> {
        let parameters = PARAMETERS.iter();
        let parameters = parameters.map(|(name, endings)| self.item(name, endings));
        let mut items: Vec<Item> = parameters.collect();
        items.push(self.reaction.clone());
        items.extend(self.elsewhere.clone());
        items.push(self.item(MOMENTS_NAME, &MOMENTS));
        items.push(self.declaration());
        items
    }

    fn item(&self, name: &'static str, endings: &[&str]) -> Item {
        let own = self.findings.findings.iter();
        let own = own.filter(|own| endings.contains(&ending(&own.property)));
        let (wrong, right): (Vec<&Finding>, Vec<&Finding>) =
            own.partition(|own| self.deviates(own));
        if wrong.is_empty() {
            let effects = step_effects(right.iter().copied());
            if let Some(effects) = effects {
                return Item::remark(Grade::Consistency, name, effects);
            }
            let is_known = right.iter().any(|own| own.measured.is_some());
            return match not_known(&right) {
                Some(told) if is_known => Item::remark(Grade::Consistency, name, told),
                None if is_known => Item::passed(Grade::Consistency, name, "as asked"),
                _ => Item::not_tested(Grade::Consistency, name, "the micro-tests do not show it"),
            };
        }
        let mut causes: Vec<String> = Vec::new();
        for cause in wrong.iter().flat_map(|own| self.causes_of(own)) {
            if causes.len() < MOST_CAUSES && !causes.contains(&cause) {
                causes.push(cause);
            }
        }
        let (expected, found) = (
            list(&wrong, |own| own.declared),
            list(&wrong, |own| own.measured),
        );
        Item::failed(Grade::Consistency, name, expected, found, causes)
    }

    /// Returns the mistakes that explain a parameter that is not as asked.
    fn causes_of(&self, own: &Finding) -> Vec<String> {
        let mut findings = self.findings.findings.iter();
        let growth = findings.find_map(|other| {
            let is_its_own = other.property.starts_with(&own.property);
            other.growth().filter(|_| is_its_own)
        });
        match (own.other_model().or(growth), own.measured, own.declared) {
            (Some(told), ..) => vec![told],
            (None, Some(found), Some(asked)) => causes_of(&own.property, found, asked),
            _ => Vec::new(),
        }
    }

    /// Compares the convention that the manifest declares with the measured one.
    fn declaration(&self) -> Item {
        let own = self.findings.findings.iter();
        let own: Vec<&Finding> = own.filter(|own| is_convention(own)).collect();
        let wrong = own.iter().copied().filter(|own| self.deviates(own));
        let wrong: Vec<&Finding> = wrong.collect();
        if self.findings.no_contact {
            return Item::not_tested(Grade::Consistency, DECLARATION, NO_CONTACT);
        }
        if wrong.is_empty() {
            return match not_known(&own) {
                Some(told) => Item::remark(Grade::Consistency, DECLARATION, told),
                None => Item::passed(Grade::Consistency, DECLARATION, "as measured"),
            };
        }
        let measured = wrong.iter().filter_map(|own| Some((own, own.measured?)));
        let mut causes: Vec<String> = Vec::new();
        for cause in measured.map(|(own, value)| self.correction(own, value)) {
            if causes.len() < MOST_CAUSES && !causes.contains(&cause) {
                causes.push(cause);
            }
        }
        let word = match wrong.iter().any(|own| own.key.is_some()) {
            true => "declared",
            false => "asked for",
        };
        let expected = format!("{} ({word})", list(&wrong, |own| own.declared));
        let found = format!("{} (measured)", list(&wrong, |own| own.measured));
        Item::failed(Grade::Consistency, DECLARATION, expected, found, causes)
    }

    /// Says how the manifest would declare the measured `value`, or what is wrong with the code if it has no word for
    /// it or the integrator is explicit Euler.
    fn correction(&self, own: &Finding, value: f64) -> String {
        if let Some(told) = own.other_model() {
            return told;
        }
        let measured = &self.findings.measured;
        let known = own.key.filter(|key| measured.reason(*key).is_none());
        known.map_or_else(
            || {
                let (name, value) = (&own.property, rounded(value));
                match own.key.and_then(|key| measured.reason(key)) {
                    Some(because) => format!("{name} is {value}, and no convention is: {because}"),
                    None => format!("{name} is {value}, for which the manifest has no word: the law is another one"),
                }
            },
            |key| {
                let is_euler = key == ConventionKey::VelocityLag && is_about(value, -0.5);
                if is_euler {
                    return "explicit Euler: positions move on with the velocities of before the kick; kick the \
                            velocities first, then move with the new ones"
                        .to_owned();
                }
                let value = measured.value(key);
                let value = value.parse::<f64>().map_or(value, |number| rounded(number).to_string());
                format!("the code has another convention than code.toml says, which might be: {key} = {value}")
            },
        )
    }

    /// Returns the conventions that the code may have: the declared one, then the measured one if that is valid and
    /// the declaration wrong. The stack is examined under the last of them.
    pub fn conventions(&self) -> Vec<ContactConvention> {
        let settled = self.findings.settled.convention;
        let mut findings = self.findings.findings.iter();
        let is_wrong = findings.any(|own| is_convention(own) && self.deviates(own));
        let measured = ContactConvention {
            restitution: settled.restitution,
            ..self.findings.measured.convention
        };
        match is_wrong && measured.validate().is_ok() {
            true => vec![settled, measured],
            false => vec![settled],
        }
    }
}

/// Names properties that are declared or asked for, and not known.
fn not_known(findings: &[&Finding]) -> Option<String> {
    let own = findings
        .iter()
        .filter(|own| own.declared.is_some() && own.measured.is_none());
    let names: Vec<&str> = own.map(|own| own.property.as_str()).collect();
    let are = if names.len() == 1 { "is" } else { "are" };
    (!names.is_empty()).then(|| {
        format!(
            "{} {are} not known: the micro-tests do not show it",
            names.join(", ")
        )
    })
}

/// Lists names and values of properties.
fn list(findings: &[&Finding], value: impl Fn(&Finding) -> Option<f64>) -> String {
    let each = findings.iter().map(|own| {
        let value = value(own).unwrap_or(f64::NAN) + 0.0;
        format!("{} {value:.6}", own.property)
    });
    each.collect::<Vec<_>>().join(", ")
}

fn rounded(value: f64) -> f64 {
    (value * 1e6).round() / 1e6 + 0.0
}

/// Returns the name of a property without the kind of contact.
fn ending(name: &str) -> &str {
    let kinds = ["pair_", "floor_", "wall_"];
    kinds
        .into_iter()
        .find_map(|kind| name.strip_prefix(kind))
        .unwrap_or(name)
}

fn is_convention(own: &Finding) -> bool {
    let ending = ending(&own.property);
    let mut parameters = PARAMETERS.iter().flat_map(|(_, endings)| *endings);
    own.growth().is_none()
        && !MOMENTS.contains(&ending)
        && !parameters.any(|other| *other == ending)
}

/// Returns the mistakes that explain `found` in place of `asked` for a parameter called `name`.
fn causes_of(name: &str, found: f64, asked: f64) -> Vec<String> {
    let texts = match (name, ending(name)) {
        ("wall_friction", _) => vec![format!(
            "the top wall has a friction of {found:.6}, and must have none"
        )],
        (_, "friction") => of_friction(found, asked, asked),
        (_, own) if own == "mass" || own.ends_with("_stiffness") || own.ends_with("_damping") => {
            meanings(name, found, asked, asked, |_| f64::NAN)
        }
        _ => Vec::new(),
    };
    let named = texts.into_iter().map(|text| format!("{name}: {text}"));
    named.collect()
}
