//! What may happen to a run at a step, or be renewed only every so many steps; the twin suffers it.

use super::touching::State;
use super::twin::{CONTACTS, FLOOR, Lists, PAIRS, Twin, WALL};
use std::mem::discriminant;

/// Digits to which restart files usually round.
const DIGITS: std::ops::RangeInclusive<usize> = 4..=8;
/// Contacts to which something may happen together, the larger sets first.
const SETS: [(&str, &[usize]); 16] = [
    ("", &[0, 1, 2, 3, 4, 5]),
    (" between cylinders", &[0, 1, 2]),
    (" at the floor", &[3, 4, 5]),
    (" of cylinder 1", &[0, 1, 3]),
    (" of cylinder 2", &[0, 2, 4]),
    (" of cylinder 3", &[1, 2, 5]),
    (" of cylinders 1 and 2", &[0]),
    (" of cylinders 1 and 3", &[1]),
    (" of cylinders 2 and 3", &[2]),
    (" of cylinder 1 at the floor", &[3]),
    (" of cylinder 2 at the floor", &[4]),
    (" of cylinder 3 at the floor", &[5]),
    (" at the top wall", &[6, 7, 8]),
    (" of cylinder 1 at the top wall", &[6]),
    (" of cylinder 2 at the top wall", &[7]),
    (" of cylinder 3 at the top wall", &[8]),
];
/// The sets of contacts that have tangential springs.
const SPRINGS: std::ops::Range<usize> = 0..12;
/// The sets of one contact with a spring, in the order of the contacts.
const SINGLE: std::ops::Range<usize> = 6..12;

/// What happens to the twin before it computes the forces of a step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Event {
    /// The tangential springs of a set in [`SPRINGS`] are lost.
    Lost(usize),
    /// They change their sign.
    Reversed(usize),
    /// The spring of the first contact is that of the second one, in its own direction or against it.
    Taken(usize, usize, bool),
    /// The springs stay where they are in the list of closed contacts, and these do not.
    Displaced,
    /// The forces of a set are not computed, and its springs forgotten if so.
    LeftOut(usize, bool),
    /// The springs are those of the step before.
    OldSprings,
    /// Places and velocities are those of the step before, with the springs or without them.
    OldBodies(bool),
    /// Places and velocities are rounded to so many digits.
    Rounded(usize),
    /// They are rounded to single precision.
    SinglePrecision,
    /// Places alone are kept.
    PlacesAlone,
    /// All velocities and spins are 0, or the spins alone.
    Stopped(bool),
    /// The forces are computed twice, and springs grow twice.
    Twice,
    /// The top wall does not move for a step.
    WallStays,
}

/// What is renewed only every so many steps.
#[derive(Debug, Clone, Copy)]
pub(super) enum Renewal {
    /// The list of contacts: one that closes later has no force until then.
    Contacts,
    /// That of pairs alone.
    Pairs,
    /// The normals of pairs.
    Normals,
    /// The place of the top wall.
    Wall,
    /// The velocities and the spin of the second body of a pair.
    Velocities,
}

pub(super) fn events() -> Vec<Event> {
    let taken = SINGLE.flat_map(|one| SINGLE.map(move |other| (one, other)));
    let taken = taken.filter(|(one, other)| one != other);
    let left_out = (0..SETS.len()).filter(|set| is_of_one_kind(SETS[*set].1));
    let single = [
        Event::Displaced,
        Event::PlacesAlone,
        Event::Stopped(true),
        Event::Stopped(false),
        Event::SinglePrecision,
        Event::OldBodies(true),
        Event::OldBodies(false),
        Event::OldSprings,
        Event::Twice,
        Event::WallStays,
    ];
    let lost = SPRINGS.map(Event::Lost);
    lost.chain(SPRINGS.map(Event::Reversed))
        .chain(
            taken.flat_map(|(one, other)| [false, true].map(|own| Event::Taken(one, other, own))),
        )
        .chain(left_out.flat_map(|set| [false, true].map(|own| Event::LeftOut(set, own))))
        .chain(single)
        .chain(DIGITS.map(Event::Rounded))
        .collect()
}

impl Event {
    /// Lets it happen to `twin`, which was `before` a step ago.
    pub fn happen(self, twin: &mut Twin, before: &Twin) {
        match self {
            Self::Lost(set) => change_springs(twin, set, 0.0),
            Self::Reversed(set) => change_springs(twin, set, -1.0),
            Self::Taken(one, other, is_against) => {
                let ([one], [other]) = (SETS[one].1, SETS[other].1) else {
                    return;
                };
                let sign = if is_against { -1.0 } else { 1.0 };
                let spring = twin.states[*other].spring;
                twin.states[*one].spring = spring.map(|part| part * sign);
            }
            Self::Displaced => twin.displace_springs(),
            Self::LeftOut(set, is_forgotten) => {
                let contacts = SETS[set].1;
                if is_forgotten {
                    let own = contacts.iter();
                    own.for_each(|contact| twin.states[*contact] = Default::default());
                }
                twin.left_out = contacts;
            }
            Self::OldSprings => twin.states = before.states,
            Self::OldBodies(with_springs) => {
                twin.bodies.clone_from(&before.bodies);
                if with_springs {
                    twin.states = before.states;
                }
            }
            Self::Rounded(digits) => {
                let printed = |number: f64| format!("{number:.*e}", digits - 1).parse();
                change_state(twin, |number| printed(number).unwrap_or(number));
            }
            Self::SinglePrecision => change_state(twin, |number| f64::from(number as f32)),
            Self::PlacesAlone => {
                change_springs(twin, 0, 0.0);
                twin.bodies
                    .iter_mut()
                    .for_each(|body| body.speed = [0.0; 3]);
            }
            Self::Stopped(is_whole) => {
                for body in &mut twin.bodies {
                    let [x, y, _] = body.speed;
                    body.speed = if is_whole { [0.0; 3] } else { [x, y, 0.0] };
                }
            }
            Self::Twice => twin.forces(),
            Self::WallStays => twin.wall = before.wall,
        }
    }

    /// Whether it can be one of several that have one cause.
    pub fn is_like(self, other: Self) -> bool {
        match (self, other) {
            (Self::Lost(_) | Self::Reversed(_) | Self::Taken(..), _) => {
                discriminant(&self) == discriminant(&other)
            }
            (Self::LeftOut(_, one), Self::LeftOut(_, other)) => one == other,
            _ => self == other,
        }
    }

    /// Whether it may happen at a step whose predecessor is not known.
    pub fn needs_no_past(self) -> bool {
        !matches!(
            self,
            Self::OldSprings | Self::OldBodies(_) | Self::WallStays
        )
    }

    pub fn in_words(self) -> String {
        let springs = |set: usize| format!("the tangential springs{}", SETS[set].0);
        match self {
            Self::Lost(set) => format!("{} are lost", springs(set)),
            Self::Reversed(set) => format!("{} change their sign", springs(set)),
            Self::Taken(one, other, is_against) => {
                let sign = if is_against { ", with the other sign" } else { "" };
                format!(
                    "the tangential spring{} is replaced by that{}{sign}",
                    SETS[one].0, SETS[other].0
                )
            }
            Self::Displaced => "a contact gets the tangential spring of another one: springs belong to places in the list of closed \
                                contacts"
                .to_owned(),
            Self::LeftOut(set, is_forgotten) => {
                let forgotten = if is_forgotten { ", and the springs forgotten," } else { "" };
                format!("the forces{} are left out{forgotten}", SETS[set].0)
            }
            Self::OldSprings => "the tangential springs are those of the step before".to_owned(),
            Self::OldBodies(true) => "the whole state is that of the step before".to_owned(),
            Self::OldBodies(false) => {
                "places and velocities are those of the step before, the springs are not".to_owned()
            }
            Self::Rounded(digits) => {
                format!("places and velocities are rounded to {digits} digits")
            }
            Self::SinglePrecision => {
                "places and velocities are rounded to single precision".to_owned()
            }
            Self::PlacesAlone => {
                "places alone are kept: velocities and tangential springs are lost".to_owned()
            }
            Self::Stopped(true) => "all velocities are set to 0".to_owned(),
            Self::Stopped(false) => "all spins are set to 0".to_owned(),
            Self::Twice => {
                "the forces are computed twice, and the tangential springs grow twice".to_owned()
            }
            Self::WallStays => "the top wall does not move for a step".to_owned(),
        }
    }

    /// The same where the sets of springs differ.
    pub fn of_any_set(self) -> String {
        match self {
            Self::Lost(_) => "tangential springs of some contacts are lost".to_owned(),
            Self::Reversed(_) => "tangential springs of some contacts change their sign".to_owned(),
            Self::Taken(..) => {
                "tangential springs of some contacts are replaced by those of other ones".to_owned()
            }
            Self::LeftOut(..) => "the forces of some contacts are left out".to_owned(),
            other => other.in_words(),
        }
    }

    /// The bodies whose contacts it changes, in the state of `twin`.
    pub fn bodies(self, twin: &Twin) -> Vec<usize> {
        let (set, is_changed): (usize, fn(&State) -> bool) = match self {
            Self::Lost(set) | Self::Reversed(set) => (set, |own| own.spring != [0.0; 2]),
            Self::LeftOut(set, _) => (set, |_| true),
            _ => return Vec::new(),
        };
        let own = SETS[set].1.iter();
        let changed = own.filter(|contact| is_changed(&twin.states[**contact]));
        let contacts: Vec<usize> = changed.copied().collect();
        let concerned = |body: &usize| contacts.iter().any(|own| is_of(*own, *body));
        let shared = |body: &usize| contacts.iter().all(|own| is_of(*own, *body));
        let all: Vec<usize> = (0..twin.bodies.len()).filter(concerned).collect();
        match all.iter().any(shared) {
            true => all.into_iter().filter(shared).collect(),
            false => all,
        }
    }
}

/// Whether contacts are all of pairs, of the floor, or of the top wall.
fn is_of_one_kind(contacts: &[usize]) -> bool {
    let mut kinds = [PAIRS, FLOOR, WALL].into_iter();
    kinds.any(|kind| contacts.iter().all(|own| kind.contains(own)))
}

/// Whether a contact is one of a body.
fn is_of(contact: usize, body: usize) -> bool {
    let (one, two) = CONTACTS[contact];
    one == body || two == Some(body)
}

fn change_springs(twin: &mut Twin, set: usize, factor: f64) {
    for contact in SETS[set].1 {
        let spring = &mut twin.states[*contact].spring;
        *spring = spring.map(|part| part * factor);
    }
}

fn change_state(twin: &mut Twin, rounded: impl Fn(f64) -> f64) {
    for body in &mut twin.bodies {
        body.at = body.at.map(&rounded);
        body.speed = body.speed.map(&rounded);
    }
}

impl Renewal {
    pub const ALL: [Self; 5] = [
        Self::Contacts,
        Self::Pairs,
        Self::Normals,
        Self::Wall,
        Self::Velocities,
    ];

    /// Prepares `twin` for a step in which it is renewed, or is not.
    pub fn step(self, twin: &mut Twin, is_renewed: bool) {
        match self {
            Self::Contacts | Self::Pairs => {
                twin.lists = if is_renewed {
                    Lists::Renewed
                } else {
                    Lists::Kept
                };
                twin.lists_pairs_alone = matches!(self, Self::Pairs);
            }
            Self::Wall => {
                let behind = if is_renewed {
                    0.0
                } else {
                    twin.run.wall_ahead - 1.0
                };
                twin.run.wall_ahead = behind;
            }
            Self::Velocities if is_renewed => {
                twin.seen_speeds = twin.bodies.iter().map(|body| body.speed).collect();
            }
            Self::Velocities => (),
            Self::Normals => {
                for law in &mut twin.contacts[PAIRS] {
                    law.first_normal = if is_renewed { 0.0 } else { 1.0 };
                }
            }
        }
    }

    pub fn in_words(self) -> &'static str {
        match self {
            Self::Contacts => "new contacts are found",
            Self::Pairs => "new contacts between cylinders are found",
            Self::Normals => "the normals of pairs are computed",
            Self::Wall => "the top wall moves",
            Self::Velocities => {
                "the velocities and the spin of the second body of a pair are renewed in the contact"
            }
        }
    }
}

/// A contact in words.
pub(super) fn words_of(contact: usize) -> &'static str {
    let of = SETS.iter().find(|(_, own)| *own == [contact]);
    of.map_or("", |(words, _)| words)
}

/// Says which contacts open or close in the step whose forces come next.
pub(super) fn changed_contacts(twin: &Twin) -> Vec<String> {
    let mut next = twin.clone();
    next.forces();
    let are_closed = |own: &Twin| own.states.map(|state| state.overlap > 0.0);
    let both = are_closed(twin).into_iter().zip(are_closed(&next));
    let changed = both.enumerate().filter(|(_, (before, now))| before != now);
    let told = changed.map(|(contact, (_, is_closed))| {
        let verb = if is_closed { "closes" } else { "opens" };
        format!("the contact{} {verb}", words_of(contact))
    });
    told.collect()
}
