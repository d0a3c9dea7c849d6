//! The search for the mistake: the twin makes every mistake of mistakes.toml at every place, and its result is
//! compared with what the code has written.

use super::evidence::{Evidence, ROUNDING};
use super::numbers::{OfContact, OfRun};
use super::table::{Flags, MOST_CAUSES, Quantity, TABLE, Value};
use super::twin::{FLOOR, PAIRS, Twin, WALL};
use rayon::prelude::*;
use std::ops::Range;

/// Mistakes up to this many times the distance of the best one count as fitting equally well.
pub(super) const AS_WELL: f64 = 3.0;

/// Numbers of the task that a code may take for one another.
const PARAMETERS: [&str; 12] = [
    "normal_stiffness",
    "tangential_stiffness",
    "damping_normal",
    "damping_tangential",
    "floor_friction",
    "cylinder_friction",
    "gravity",
    "time_step",
    "wall_speed",
    "moment_of_inertia",
    "ramp_steps",
    "rest_steps",
];

/// The numbers of a task, as one contact sees them.
#[derive(Clone, Copy)]
struct Task {
    contacts: [OfContact; 9],
    run: OfRun,
    contact: usize,
}

impl Task {
    fn of(&self, name: &str) -> f64 {
        let (mut own, mut run) = (self.contacts[self.contact], self.run);
        match name {
            "floor_friction" => self.contacts[FLOOR.start].friction,
            "cylinder_friction" => self.contacts[PAIRS.start].friction,
            _ => own
                .by_name(name)
                .or_else(|| run.by_name(name))
                .map_or(f64::NAN, |own| *own),
        }
    }

    fn other_friction(&self) -> f64 {
        self.of(if FLOOR.contains(&self.contact) {
            "cylinder_friction"
        } else {
            "floor_friction"
        })
    }
}

/// Pairs of numbers that a code may exchange.
const EXCHANGED: [(&str, &str); 3] = [
    ("normal_stiffness", "tangential_stiffness"),
    ("damping_normal", "damping_tangential"),
    ("ramp_steps", "rest_steps"),
];

/// What a fault does with its fields.
#[derive(Clone, Copy)]
enum Act<'a> {
    Replace(&'a Value),
    Parameter(&'a str),
    Set(f64),
}

/// A mistake at some contacts, or in the run.
struct Fault<'a> {
    text: String,
    contacts: Range<usize>,
    acts: Vec<(&'a str, Act<'a>)>,
}

impl Fault<'_> {
    fn make(&self, twin: &mut Twin) {
        let mut task = Task {
            contacts: twin.contacts,
            run: twin.run,
            contact: 0,
        };
        for (name, act) in &self.acts {
            for contact in self.contacts.clone() {
                task.contact = contact;
                if let Some(own) = twin.contacts[contact].by_name(name) {
                    *own = act.value(name, *own, &task);
                }
            }
            if let Some(own) = twin.run.by_name(name) {
                *own = act.value(name, *own, &task);
            }
        }
    }
}

impl Act<'_> {
    fn value(&self, name: &str, asked: f64, task: &Task) -> f64 {
        let other = if name.contains("friction") {
            task.other_friction()
        } else {
            asked
        };
        match self {
            Self::Replace(value) => value.of(asked, other, |number| match number {
                "own_stiffness" if name.contains("tangential") => task.of("tangential_stiffness"),
                "own_stiffness" => task.of("normal_stiffness"),
                number => task.of(number),
            }),
            Self::Parameter(name) => task.of(name),
            Self::Set(value) => *value,
        }
    }
}

/// Returns the kind of a number; only numbers of one kind are taken for one another.
fn kind(name: &str) -> usize {
    let kinds = ["stiffness", "damping", "friction", "steps"];
    kinds
        .iter()
        .position(|kind| name.contains(kind))
        .unwrap_or(kinds.len())
}

/// Contacts that may share a mistake: all, those of one kind, and single ones.
const PLACES: [(&str, Range<usize>); 12] = [
    ("at every contact", 0..9),
    ("between cylinders", PAIRS),
    ("at the floor", FLOOR),
    ("at the top wall", WALL),
    ("between cylinders and at the floor", 0..6),
    ("between cylinders 1 and 2", 0..1),
    ("between cylinders 1 and 3", 1..2),
    ("between cylinders 2 and 3", 2..3),
    ("between floor and cylinder 1", 3..4),
    ("between floor and cylinder 2", 4..5),
    ("between floor and cylinder 3", 5..6),
    ("between top wall and cylinder 1", 6..7),
];
/// The places on one side of the stack.
const ONE_SIDED: [Range<usize>; 4] = [0..1, 1..2, 4..5, 5..6];
/// Number of places with more than one contact, which come first, and number of values that are tried at a single
/// contact.
const KINDS: usize = 5;
const AT_SINGLE: usize = 4;

/// Returns all mistakes.
fn faults() -> Vec<Fault<'static>> {
    let table = &*TABLE;
    // A mistake with a name of its own comes before values that have the same effect.
    let mut faults: Vec<Fault> = table
        .loading
        .iter()
        .map(|own| own.fault(None, 0..0))
        .collect();
    for (at, contacts) in &PLACES {
        let own = table.law.iter();
        faults.extend(own.map(|own| own.fault(Some(at), contacts.clone())));
    }
    for (place, (at, contacts)) in PLACES.iter().enumerate() {
        for quantity in &table.contact {
            let values = if place < KINDS {
                table.value.len()
            } else {
                AT_SINGLE
            };
            of_quantity(quantity, &format!(" {at}"), contacts, values, &mut faults);
        }
    }
    for quantity in &table.run {
        of_quantity(quantity, "", &(0..0), table.value.len(), &mut faults);
    }
    faults.extend(EXCHANGED.into_iter().map(|(one, two)| Fault {
        text: format!("{one} and {two} are exchanged"),
        contacts: 0..9,
        acts: vec![(one, Act::Parameter(two)), (two, Act::Parameter(one))],
    }));
    faults
}

impl Flags {
    fn fault(&'static self, at: Option<&str>, contacts: Range<usize>) -> Fault<'static> {
        let text = at.map_or_else(|| self.says.clone(), |at| format!("{} ({at})", self.says));
        let acts = self
            .set
            .iter()
            .map(|(name, value)| (name.as_str(), Act::Set(*value)));
        Fault {
            text,
            contacts,
            acts: acts.collect(),
        }
    }
}

fn of_quantity(
    quantity: &'static Quantity,
    at: &str,
    contacts: &Range<usize>,
    values: usize,
    faults: &mut Vec<Fault<'static>>,
) {
    let mut add = |says: &str, act: Act<'static>| {
        let acts = quantity.fields.iter().map(|field| (field.as_str(), act));
        let (text, contacts) = (format!("{}{at}: {says}", quantity.is), contacts.clone());
        faults.push(Fault {
            text,
            contacts,
            acts: acts.collect(),
        });
    };
    let own = TABLE.value[..values].iter();
    for value in own.filter(|value| quantity.is.contains(&value.only)) {
        add(&value.says, Act::Replace(value));
    }
    if quantity.parameter && values > AT_SINGLE {
        let is_other =
            |name: &&&str| !quantity.is.contains(**name) && kind(name) == kind(&quantity.is);
        for name in PARAMETERS.iter().filter(is_other) {
            add(
                &format!("`{name}` stands in its place"),
                Act::Parameter(name),
            );
        }
    }
}

/// Returns the mistakes that explain all `evidence`, best first.
pub(super) fn explanations(evidence: &[Evidence]) -> Vec<String> {
    let mut faults = faults();
    if evidence.iter().any(Evidence::is_symmetric) {
        faults.retain(|fault| !ONE_SIDED.contains(&fault.contacts));
    }
    let single = faults
        .par_iter()
        .filter_map(|fault| Some((score(evidence, fault)?, fault.text.clone())));
    best(single.collect())
}

/// Returns the best of some mistakes, which come with their distances.
fn best(mut fitting: Vec<(f64, String)>) -> Vec<String> {
    fitting.sort_by(|left, right| left.0.total_cmp(&right.0));
    let best = fitting.first().map_or(0.0, |best| best.0);
    let as_good = fitting
        .into_iter()
        .take_while(|(rest, _)| *rest <= AS_WELL * best.max(0.1 * ROUNDING));
    let mut causes: Vec<String> = Vec::new();
    for (_, text) in as_good {
        // If the place makes no difference, the first one that fits is enough.
        let told = |other: &String| stripped(other) == stripped(&text);
        if causes.len() < MOST_CAUSES && !causes.iter().any(told) {
            causes.push(text);
        }
    }
    causes
}

/// Whether the text of a mistake places it at contacts.
pub(super) fn is_of_contacts(text: &str) -> bool {
    PLACES.iter().any(|(at, _)| text.contains(at))
}

/// Returns a text without its place.
fn stripped(text: &str) -> String {
    PLACES
        .iter()
        .rev()
        .fold(text.to_owned(), |text, (at, _)| text.replace(at, ""))
}

/// Returns the largest distance of the twin with the fault, if that explains all `evidence`.
fn score(evidence: &[Evidence], fault: &Fault) -> Option<f64> {
    let mut worst: f64 = 0.0;
    for own in evidence {
        let distance = own.distance(|twin| fault.make(twin), own.allowed());
        if distance > own.allowed() {
            return None;
        }
        worst = worst.max(distance);
    }
    Some(worst)
}

#[cfg(test)]
mod tests {
    use super::super::{ask_native, case};
    use super::*;
    use crate::model::{ContactConvention, Law};

    #[test]
    fn every_field_in_the_table_is_a_number_of_the_twin() {
        let mut twin = Twin::of_stack(&case(ContactConvention::TURNING));
        let faults = faults();
        let acts = faults.iter().flat_map(|fault| {
            fault
                .acts
                .iter()
                .map(|(field, _)| (*field, &fault.contacts))
        });
        for (field, contacts) in acts {
            let at_contact =
                |twin: &mut Twin| twin.contacts[contacts.start].by_name(field).is_some();
            let is_known = twin.run.by_name(field).is_some()
                || (!contacts.is_empty() && at_contact(&mut twin));
            assert!(is_known, "{field}");
        }
    }

    /// A mistake that a twin makes is the one that is found.
    fn assert_found(convention: ContactConvention, mistakes: &[&str]) {
        let answers = ask_native(convention);
        for says in mistakes {
            let faults = faults();
            let mut named = faults.iter();
            let fault = named
                .find(|fault| fault.text.starts_with(says))
                .expect("it is in the table");
            let motions = answers
                .iter()
                .map(|answer| Evidence::of_motion(answer, convention));
            let wrong = motions.map(|own| own.written_by(|twin| fault.make(twin), |_, _| ()));
            let causes = explanations(&wrong.collect::<Vec<_>>());
            assert!(causes[0].starts_with(says), "{says}: {causes:?}");
        }
    }

    #[test]
    fn a_mistake_in_the_law_is_found_among_all() {
        let of_any_law = [
            "damping_normal between cylinders: its sign is wrong",
            "Coulomb's limit has the spring's part",
            "the tangential spring is cleared",
            "the growth of the tangential spring in a step (relative tangential velocity times time step) at the floor: it is divided",
            "explicit Euler",
        ];
        let fixed = ContactConvention::PAPER;
        let hertz = ContactConvention::with_law(Law::HERTZ);
        for convention in [ContactConvention::TURNING, fixed, hertz] {
            assert_found(convention, &of_any_law);
        }
        let of_hertz = [
            "normal and tangential force have the square root of the overlap once less than the law",
            "the tangential stiffness is divided by the square root of the overlap",
            "the normal damping is divided by the fourth root of the overlap",
        ];
        assert_found(hertz, &of_hertz);
    }
}
