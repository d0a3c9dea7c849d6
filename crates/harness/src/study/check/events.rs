//! Events: what happens to a run that is right before and obeys the law afterwards, such as springs that are lost at a
//! restart or a state that is rounded, and what is renewed only every so many steps.
//!
//! The twin goes on from the last row that is right, suffers an event at each of the steps until the first row that is
//! off, and the event is the one with which that row is the code's.

use super::event::{Event, Renewal, changed_contacts, events};
use super::evidence::{Evidence, ROUNDING};
use super::search::AS_WELL;
use super::twin::Twin;
use rayon::prelude::*;
use std::cell::RefCell;

/// Largest distance of rows that have the same law, integrator and events: rounding.
const SAME: f64 = 1e-9;
/// Fraction of a deviation that may remain with its event, which is exactly the code's, and what rounding may leave at
/// least. Other events come near where a deviation is small.
const LEFT: f64 = 1e-3;
const LEAST: f64 = 1e-11;
/// Fraction of the motions that are off which an event must explain.
const MOST: f64 = 0.5;
/// So many events in one run are enough to tell what they are.
const MOST_EVENTS: usize = 8;
/// So many events at equal intervals show a rhythm.
const RHYTHM: usize = 3;
/// Intervals at which codes usually renew lists, balance loads or write restart files, in steps.
const INTERVALS: [u64; 18] = [
    2, 3, 4, 5, 10, 15, 20, 25, 30, 40, 50, 100, 200, 250, 500, 1000, 2000, 5000,
];
/// Number of steps and places that are told.
const MOST_TOLD: usize = 3;
/// Most decimals of a place that is worth its name.
const DECIMALS: usize = 2;
/// Probability that a step of a body crosses such a place by chance, above which none is named.
const BY_CHANCE: f64 = 0.05;
/// Largest way of a body in a step, in units of r, that may be rounding.
const AT_REST: f64 = 1e-12;
/// What may have happened.
pub(super) const OCCASIONS: &str =
    "as at a restart, a change of processor, of a mesh element or of a list of contacts";
/// What may have happened if a contact opens or closes in the same step.
const OF_LISTS: &str = "as if a list of contacts were changed while it is read, or what belongs to a contact were found by its place in it";

/// An event at a step of the compression or of a micro-test, and how the bodies move in the step that leads there.
struct Happened {
    /// What may have happened, as well the one as the other.
    events: Vec<Event>,
    step: u64,
    /// Round numbers that the horizontal positions of bodies concerned pass in this step.
    places: Vec<String>,
    /// Contacts that open or close in this step.
    occasions: Vec<String>,
}

/// Returns the event that explains all that is off in the `motions` and in the stack of a code whose law and integrator
/// are those of the twin; `stacks` are its rows up to the peak, and all of them.
pub(super) fn explanation(stacks: &[Evidence], motions: &[Evidence]) -> Option<String> {
    let is_off = |own: &&Evidence| own.before >= ROUNDING;
    let motions: Vec<&Evidence> = motions.iter().filter(is_off).collect();
    let stack = stacks.iter().find(is_off);
    let all: Vec<&Evidence> = motions.iter().copied().chain(stack).collect();
    if all.is_empty() {
        return None;
    }
    // Beyond the peak rounding grows, and what explains the motions need not explain every row.
    let is_needed = motions.is_empty() || stacks.first().filter(is_off).is_some();
    renewed(&all)
        .or_else(|| single(stack, is_needed, &motions))
        .or_else(|| rhythmic(&all))
        .or_else(|| of_motions(&motions))
}

/// Returns what happens in the motions alone: the stack of a code with such a mistake may be another one from the beginning.
fn of_motions(motions: &[&Evidence]) -> Option<String> {
    let is_any = !motions.is_empty();
    is_any.then(|| renewed(motions).or_else(|| single(None, false, motions)))?
}

/// Returns the events at single steps of the `motions` and of the stack, which they must explain if `is_needed`. One event
/// may lead to others that no twin suffers, so that most of the motions are enough.
fn single(stack: Option<&Evidence>, is_needed: bool, motions: &[&Evidence]) -> Option<String> {
    let mut kind = None;
    let each = motions.iter().map(|own| happened(own, &mut kind));
    let explained: Vec<Vec<Happened>> = each.flatten().collect();
    let count = explained.len();
    if (count as f64) < MOST * motions.len() as f64 {
        return None;
    }
    let of_motions: Vec<Happened> = explained.into_iter().flatten().collect();
    let of_stack = match stack.map(|own| happened(own, &mut kind)) {
        Some(None) if is_needed => return None,
        own => own.flatten().unwrap_or_default(),
    };
    let all = || of_motions.iter().chain(&of_stack);
    let is_common = |event: &&Event| all().all(|own| own.events.contains(event));
    let what = match all().next()?.events.iter().find(is_common) {
        Some(event) => event.in_words(),
        None => kind?.of_any_set(),
    };
    let before = stack.map_or(0, |own| own.twin.preparation());
    let told = [
        when(&of_motions, "of a micro-test", 0),
        when(&of_stack, "of the compression", before),
    ];
    let told: Vec<String> = told.into_iter().flatten().collect();
    let begun: Vec<&Happened> = beginnings(&of_motions)
        .chain(beginnings(&of_stack))
        .collect();
    let is_of_lists = begun.iter().all(|own| !own.occasions.is_empty());
    let occasion = match is_of_lists {
        true => {
            let occasions = distinct(begun.iter().flat_map(|own| &own.occasions));
            format!("when {}, {OF_LISTS}", listed(&occasions))
        }
        false => OCCASIONS.to_owned(),
    };
    let explained = match count == motions.len() {
        true => String::new(),
        false => format!(
            "; that explains {count} of the {} motions that are off",
            motions.len()
        ),
    };
    Some(format!(
        "{what} {}, {occasion}{explained}",
        told.join(", and ")
    ))
}

/// What does not go on from the step before.
fn beginnings(all: &[Happened]) -> impl Iterator<Item = &Happened> {
    let goes_on = |place: usize| place > 0 && all[place - 1].step + 1 == all[place].step;
    let begun = all.iter().enumerate();
    begun.filter_map(move |(place, own)| (!goes_on(place)).then_some(own))
}

/// Says at which steps of a run something has happened, or has begun to happen, and where.
fn when(all: &[Happened], whose: &str, before: u64) -> Option<String> {
    let mut steps: Vec<u64> = distinct(beginnings(all).map(|own| own.step));
    steps.sort_unstable();
    if steps.is_empty() {
        return None;
    }
    if beginnings(all).count() < all.len() {
        let word = if steps.len() > 1 { "steps" } else { "step" };
        return Some(format!("from {word} {} {whose} on", listed(&steps)));
    }
    let word = if steps.len() > 1 { "steps" } else { "step" };
    let mut text = format!("at {word} {} {whose}", listed(&steps));
    let mut apart = steps.windows(2).map(|two| two[1].abs_diff(two[0]));
    let interval = apart.next();
    match interval.filter(|_| steps.len() >= RHYTHM) {
        Some(every) if apart.all(|own| own == every) => text += &format!(" (every {every} steps)"),
        _ if before > 0 && steps.len() == 1 => {
            text += &format!(" (step {} of the run)", before + steps[0]);
        }
        _ => {}
    }
    if all.iter().all(|own| !own.places.is_empty()) {
        let places = distinct(all.iter().flat_map(|own| &own.places));
        text += &format!(", where {}", listed(&places));
    }
    Some(text)
}

fn distinct<T: PartialEq>(all: impl IntoIterator<Item = T>) -> Vec<T> {
    let mut own: Vec<T> = Vec::new();
    for one in all {
        if !own.contains(&one) {
            own.push(one);
        }
    }
    own
}

/// Lists the first of some values.
fn listed<T: ToString>(all: &[T]) -> String {
    let told = all.iter().take(MOST_TOLD).map(T::to_string);
    let more = if all.len() > MOST_TOLD { ", …" } else { "" };
    format!("{}{more}", told.collect::<Vec<_>>().join(", "))
}

/// Says which round number a coordinate called `name` passes, if it would not do so in any step.
fn passed(name: &str, [from, to]: [f64; 2]) -> Option<String> {
    let (low, high) = (from.min(to), from.max(to));
    (0..=DECIMALS).find_map(|decimals| {
        let unit = libm::exp10(-(decimals as f64));
        let place = (high / unit).floor() * unit;
        let is_rare = high - low > AT_REST && high - low < BY_CHANCE * unit;
        (is_rare && place >= low).then(|| format!("{name} passes {:.decimals$}", place + 0.0))
    })
}

/// A twin before the forces of a step.
type Moment = (u64, Twin);

/// Returns the events of a `kind`, or of any, that explain a run step by step, and sets the kind.
fn happened(own: &Evidence, kind: &mut Option<Event>) -> Option<Vec<Happened>> {
    let (mut base, mut all): (Moment, Vec<Happened>) = ((0, own.twin.started()), Vec::new());
    while let Some((moments, off)) = until_off(own, &base) {
        if all.len() == MOST_EVENTS {
            break;
        }
        let mut events = events();
        events.retain(|event| kind.is_none_or(|kind| event.is_like(kind)));
        let after = |(place, event): (usize, Event)| {
            let (step, mut twin) = moments[place].clone();
            event.happen(&mut twin, &moments[place - 1].1);
            (step, twin)
        };
        let places = 1..moments.len();
        let candidates = places.flat_map(|place| events.iter().map(move |event| (place, *event)));
        let fitting: Vec<(f64, (usize, Event))> = candidates
            .collect::<Vec<_>>()
            .into_par_iter()
            .map(|candidate| (own.next_distance(after(candidate)), candidate))
            .filter(|(distance, _)| *distance <= allowed(off))
            .collect();
        let closest = fitting
            .iter()
            .map(|fit| fit.0)
            .fold(f64::INFINITY, f64::min);
        let bound = AS_WELL * closest.max(LEAST);
        let as_well = fitting.into_iter().filter(|fit| fit.0 <= bound);
        // Of those that fit as well, the ones after which most rows are right.
        let followed =
            as_well.map(|(_, candidate)| (own.rows_right(after(candidate), SAME), candidate));
        let followed: Vec<(usize, (usize, Event))> = followed.collect();
        let most = followed.iter().map(|(rows, _)| *rows).max()?;
        let mut best = followed.iter().filter(|(rows, _)| *rows == most);
        let &(_, (place, event)) = best.next()?;
        let same = best.filter(|(_, (other, _))| *other == place);
        let events: Vec<Event> = [event]
            .into_iter()
            .chain(same.map(|(_, (_, event))| *event))
            .collect();
        kind.get_or_insert(event);
        let [before, now] = [place - 1, place].map(|place| &moments[place].1);
        let concerned = events.iter().flat_map(|event| event.bodies(now));
        let places = distinct(concerned).into_iter().filter_map(|body| {
            let across = [before, now].map(|twin| twin.bodies[body].at[0]);
            passed(&format!("x{}", body + 1), across)
        });
        all.push(Happened {
            places: places.collect(),
            occasions: changed_contacts(now),
            step: moments[place].0,
            events,
        });
        base = after((place, event));
    }
    (!all.is_empty()).then_some(all)
}

/// Goes on to the first row that is off; returns the moments since the last one that is right, and the distance.
fn until_off(own: &Evidence, base: &Moment) -> Option<(Vec<Moment>, f64)> {
    let moments: RefCell<Vec<Moment>> = RefCell::default();
    let (mut step, mut off) = (base.0, None);
    let (first, mut twin) = base.clone();
    twin.go_on(
        first,
        |twin, _| {
            moments.borrow_mut().push((step, twin.clone()));
            step += 1;
        },
        |step, row| {
            let Some(distance) = own.distance_at(step, row) else {
                return own.found.last().is_some_and(|(last, _)| step < *last);
            };
            if distance < SAME {
                let mut moments = moments.borrow_mut();
                let right = moments.len() - 1;
                moments.drain(..right);
                return true;
            }
            off = Some(distance);
            false
        },
    );
    Some((moments.into_inner(), off?))
}

/// The distance that an event may leave of one that is `off`.
fn allowed(off: f64) -> f64 {
    SAME.min(LEAST.max(LEFT * off))
}

/// Returns what is renewed only every so many steps.
fn renewed(all: &[&Evidence]) -> Option<String> {
    let candidates = Renewal::ALL
        .into_iter()
        .flat_map(|renewal| rhythms().map(move |rhythm| (renewal, rhythm)));
    let (renewal, (every, _)) = first_fitting(candidates, all, |twin, step, (renewal, rhythm)| {
        renewal.step(twin, step == 0 || is_in(*rhythm, step));
    })?;
    let ends = all.iter().filter_map(|own| own.found.last());
    let longest = ends.map(|(step, _)| *step).max();
    let when = match longest.is_some_and(|longest| every < longest) {
        true => format!("every {every} steps alone"),
        false => "at the beginning of a run alone".to_owned(),
    };
    Some(format!("{} {when}", renewal.in_words()))
}

/// Returns the event that happens at equal intervals from the beginning of the run, or once in its preparation.
fn rhythmic(all: &[&Evidence]) -> Option<String> {
    let events = events().into_iter().filter(|event| event.needs_no_past());
    let often = || rhythms().flat_map(|rhythm| [(rhythm, true), (rhythm, false)]);
    let candidates = events.flat_map(|event| often().map(move |rhythm| (event, rhythm)));
    let happens = |twin: &mut Twin, step, (event, (rhythm, is_repeated)): &(Event, _)| {
        if if *is_repeated {
            is_in(*rhythm, step)
        } else {
            step == rhythm.1
        } {
            let before = twin.clone();
            event.happen(twin, &before);
        }
    };
    let (event, ((every, first), is_repeated)) = first_fitting(candidates, all, happens)?;
    let when = match is_repeated {
        true => format!("every {every} steps of the run, first at step {first}"),
        false => format!("at step {first} of the run"),
    };
    Some(format!("{} {when}, {OCCASIONS}", event.in_words()))
}

/// Intervals, each with the step that comes first: the first one, or the last one of the first interval.
fn rhythms() -> impl Iterator<Item = (u64, u64)> {
    let both = |every| [(every, every), (every, every - 1)];
    INTERVALS.into_iter().flat_map(both)
}

/// Whether a step is one of a rhythm.
fn is_in((every, first): (u64, u64), step: u64) -> bool {
    step >= first && (step - first).is_multiple_of(every)
}

/// Returns the first candidate that explains all evidence.
fn first_fitting<T: Copy + Send + Sync>(
    candidates: impl Iterator<Item = T>,
    all: &[&Evidence],
    interrupt: impl Fn(&mut Twin, u64, &T) + Sync,
) -> Option<T> {
    let explains = |candidate: &T| {
        all.iter().all(|own| {
            let allowed = allowed(own.before);
            own.distance_interrupted(|twin, step| interrupt(twin, step, candidate), allowed)
                <= allowed
        })
    };
    let candidates: Vec<T> = candidates.collect();
    candidates.into_par_iter().find_first(explains)
}

#[cfg(test)]
mod tests {
    use super::super::invariances::starts;
    use super::super::{ask_native, case};
    use super::*;
    use crate::dem::{compress_stack, run_contact_test};
    use crate::model::ContactConvention;
    use crate::runs::Answer;

    /// A stack that a right code has compressed.
    fn right() -> Evidence {
        let case = case(ContactConvention::TURNING);
        let series = compress_stack(&case, || true).expect("a series");
        Evidence {
            same: ROUNDING,
            ..Evidence::of_stack(&series, &case, case.convention, false)
        }
    }

    fn told(own: Evidence) -> Option<String> {
        explanation(&[own], &[])
    }

    /// The stack of a code to which an event happens once.
    fn with(right: &Evidence, event: Event, step: u64) -> Evidence {
        let (at, before) = (
            right.twin.preparation() + step,
            RefCell::new(right.twin.clone()),
        );
        right.clone().written_by(
            |_| (),
            |twin, now| {
                let own = twin.clone();
                if now == at {
                    event.happen(twin, &before.borrow());
                }
                before.replace(own);
            },
        )
    }

    #[test]
    fn every_event_is_found_at_its_step() {
        let right = right();
        let shows = |event: &Event| {
            let shown = [1700, 7777].map(|step| {
                let written = with(&right, *event, step);
                if written.before < ROUNDING {
                    return false;
                }
                let text = told(written.clone()).unwrap_or_default();
                let is_told = |own: &Event| {
                    let told = format!("{} at step {step} of the compression", own.in_words());
                    text.starts_with(&told)
                };
                let found = events().into_iter().find(is_told);
                let found = found.unwrap_or_else(|| panic!("{event:?} at step {step}: {text:?}"));
                // Another event may have the same effect.
                let again = with(&right, found, step);
                let apart = again.found.iter().zip(&written.found).map(|(one, two)| {
                    let each = one.1.iter().zip(&two.1).zip(&right.columns);
                    each.fold(0.0, |worst, ((one, two), column)| {
                        f64::max(worst, (one - two).abs() / column.scale)
                    })
                });
                let apart = apart.fold(0.0, f64::max);
                assert!(apart < ROUNDING, "{event:?} at step {step}: {text:?}");
                true
            });
            shown.contains(&true)
        };
        let mut hidden: Vec<Event> = events()
            .into_par_iter()
            .filter(|event| !shows(event))
            .collect();
        // No contact opens or closes at these steps, and the stack is its own mirror image.
        hidden.retain(|event| !matches!(event, Event::Taken(..) | Event::Displaced));
        // Cylinders 2 and 3 do not touch, cylinder 1 not the floor, and 2 and 3 not the top wall.
        let set = |event: &Event| match event {
            Event::Lost(set) | Event::Reversed(set) | Event::LeftOut(set, _) => Some(*set),
            _ => None,
        };
        let sets: Vec<Option<usize>> = distinct(hidden.iter().map(set));
        assert_eq!(sets, [8, 9, 14, 15].map(Some));
    }

    /// What is told of motions in which contacts come and go if something happens in them at a step.
    fn told_of_motions(happens: impl Fn(&mut Twin, u64) + Sync) -> String {
        let convention = ContactConvention::TURNING;
        let motions: Vec<Evidence> = starts(&convention, false)
            .into_iter()
            .map(|start| {
                let answer = Answer {
                    input_hash: String::new(),
                    motion: run_contact_test(&start.test).expect("it is finite"),
                    test: start.test,
                };
                let own = Evidence {
                    same: ROUNDING,
                    ..Evidence::of_motion(&answer, convention)
                };
                own.written_by(|_| (), &happens)
            })
            .collect();
        explanation(&[], &motions).unwrap_or_default()
    }

    #[test]
    fn mistakes_in_lists_of_contacts_are_told_with_the_contact_that_opens_or_closes() {
        let text = told_of_motions(|twin, _| twin.displace_springs());
        assert!(
            text.contains("springs belong to places in the list"),
            "{text}"
        );
        assert!(text.contains(OF_LISTS), "{text}");
        // The floor of cylinder 1 is passed over when the pair opens.
        let text = told_of_motions(|twin, _| {
            let opens = "the contact of cylinders 1 and 2 opens".to_owned();
            if changed_contacts(twin).contains(&opens) {
                Event::LeftOut(9, false).happen(twin, &twin.clone());
            }
        });
        let expected = "the forces of cylinder 1 at the floor are left out at step";
        assert!(text.starts_with(expected), "{text}");
        assert!(
            text.contains("when the contact of cylinders 1 and 2 opens, as if a list"),
            "{text}"
        );
        let text = told_of_motions(|twin, now| Renewal::Pairs.step(twin, now.is_multiple_of(50)));
        assert_eq!(
            text,
            "new contacts between cylinders are found every 50 steps alone"
        );
        let text = told_of_motions(|twin, now| Renewal::Pairs.step(twin, now == 0));
        assert_eq!(
            text,
            "new contacts between cylinders are found at the beginning of a run alone"
        );
    }

    #[test]
    fn what_is_renewed_at_intervals_is_found() {
        let right = right();
        for (renewal, every) in [
            (Renewal::Contacts, 25),
            (Renewal::Normals, 20),
            (Renewal::Wall, 10),
            (Renewal::Velocities, 20),
        ] {
            let renewed = |twin: &mut Twin, now: u64| renewal.step(twin, now.is_multiple_of(every));
            let text = told(right.clone().written_by(|_| (), renewed)).unwrap_or_default();
            assert_eq!(
                text,
                format!("{} every {every} steps alone", renewal.in_words())
            );
        }
    }

    #[test]
    fn springs_that_are_lost_at_intervals_and_at_places_are_told_with_them() {
        let right = right();
        let lost = |twin: &mut Twin| Event::Lost(4).happen(twin, &twin.clone());
        let often = right.clone().written_by(
            |_| (),
            |twin, now| {
                if now % 500 == 499 {
                    lost(twin)
                }
            },
        );
        let text = told(often).unwrap_or_default();
        assert!(text.starts_with("the tangential springs of cylinder 2 are lost every 500 steps of the run, first at step 499"), "{text}");
        let last = RefCell::new(1.0);
        let there = right.written_by(
            |_| (),
            |twin, _| {
                let x = twin.bodies[1].at[0];
                if (last.replace(x) < 1.02) != (x < 1.02) {
                    lost(twin);
                }
            },
        );
        let text = told(there).unwrap_or_default();
        assert!(text.contains("where x2 passes 1.02"), "{text}");
    }

    #[test]
    fn another_law_is_no_event() {
        let right = right();
        assert_eq!(told(right.clone()), None);
        let other = right.written_by(
            |twin| {
                twin.contacts[3..6]
                    .iter_mut()
                    .for_each(|own| own.damping_tangential *= 1.1)
            },
            |_, _| (),
        );
        assert!(other.before >= ROUNDING);
        assert_eq!(told(other), None);
    }

    #[test]
    fn micro_tests_show_a_place_too() {
        let convention = ContactConvention::TURNING;
        let motions: Vec<Evidence> = ask_native(convention)
            .iter()
            .map(|answer| {
                let last = RefCell::new(f64::NAN);
                let own = Evidence {
                    same: ROUNDING,
                    ..Evidence::of_motion(answer, convention)
                };
                own.written_by(
                    |_| (),
                    |twin, _| {
                        let x = twin.bodies[0].at[0];
                        let before = last.replace(x);
                        if !before.is_nan() && (before < 0.0) != (x < 0.0) {
                            Event::Lost(3).happen(twin, &twin.clone());
                        }
                    },
                )
            })
            .collect();
        let text = explanation(&[], &motions).unwrap_or_default();
        assert!(text.contains("x1 passes 0"), "{text}");
    }
}
