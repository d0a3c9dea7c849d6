//! Items on a stack and on micro-tests, and the one mistake that explains those that failed.

use super::evidence::{Evidence, MOVED, ROUNDING, SAME};
use super::first_force::first_wrong;
use super::micro::{self, Micro};
use super::report::{Grade, Item, Outcome};
use super::stack::{self, Scheme, at_first_sight, in_single_precision};
use super::table::{MOST_CAUSES, usual};
use super::{equations, events, invariances, search, written};
use crate::model::{Case, ContactConvention};
use crate::runs::Answer;
use crate::series::Series;
use crate::study::convention::Finding;

/// Largest distance of motions that have the same law and integrator: rounding, which single contacts do not amplify.
const SAME_MOTION: f64 = 1e-9;
/// Largest distance of motions in which contacts come and go: bodies turn about each other by up to 0.05 rad in a step, and by
/// the cube of that codes with the same law may differ.
const OF_THIRD_ORDER: f64 = 1.25e-4;
/// Deviation of forces, in units of what counts as the same, that would show in the motion: a force that is off by a part of the
/// largest one for a tenth of a contact moves a body by a hundredth of that part of its way.
const CLEARLY: f64 = 100.0;
/// Prefix of entries for valid rules that tristack does not have.
const NO_MISTAKE: &str = "no mistake";
/// Steps by which the velocities of a leapfrog lag behind the positions.
const LEAPFROG_LAG: f64 = 0.5;
/// The columns of micro-tests that follow from the motion.
const REPORTED: [&str; 7] = [
    "fx1",
    "fy1",
    "torque1",
    "fx2",
    "fy2",
    "torque2",
    "wall_force",
];
/// Number of micro-tests that agree to the last digits only if the code has the integrator of the twin.
const MANY_EXACT: usize = 5;

/// A series of a stack, and the case that it is of.
pub(super) type Compressed<'a> = (&'a Series, &'a Case);

/// Returns the items on the `stack` and on the micro-tests, if there are any; `declared` is the convention of the
/// code without them. Failed items are explained by the mistake that explains all of them, else by a gross mistake or
/// the equations that fail, else by their own causes, else by the usual ones. `run` carries out another case with the
/// code.
pub(super) fn items(
    stack: Option<Compressed>,
    declared: ContactConvention,
    micro: Option<&Micro>,
    run: &dyn Fn(&Case) -> Option<Series>,
) -> Vec<Item> {
    let of_micro = items_of(micro);
    let conventions = micro.map_or_else(|| vec![declared], Micro::conventions);
    let convention = conventions.last().copied().unwrap_or(declared);
    let known = Known::of(stack, micro, convention);
    let mut items = stack.map_or_else(Vec::new, |(series, case)| {
        let depends_on_step = micro.is_some_and(Micro::depends_on_step);
        let finer = || {
            let mut fine = *case;
            fine.protocol.time_step *= 0.5;
            let series = depends_on_step.then(|| run(&fine)).flatten()?;
            Some(Evidence::of_stack(&series, &fine, convention, false))
        };
        let scheme = Scheme {
            is_late: micro.is_some_and(Micro::forces_are_late),
            finer: &finer,
        };
        stack::items(series, case, &known.stacks, &scheme)
    });
    items.extend(of_micro);
    items.extend(known.item());
    if !items.iter().any(is_to_be_explained) {
        return items;
    }
    let found = conventions
        .into_iter()
        .enumerate()
        .find_map(|(place, convention)| {
            let causes = Known::of(stack, micro, convention).causes();
            (!causes.is_empty()).then_some((place, causes))
        });
    let (place, causes) = found.unwrap_or_default();
    if causes
        .first()
        .is_some_and(|cause| cause.starts_with(NO_MISTAKE))
    {
        return items
            .into_iter()
            .map(|item| excused(item, &causes[0]))
            .collect();
    }
    let located = match causes.is_empty() {
        true => located(&known, stack, micro),
        false => Located::default(),
    };
    let plain = stack.and_then(|(series, case)| at_first_sight(series, &case.stack));
    let plain = plain.filter(|_| !located.is_known);
    // Single precision explains what its rounding does; the equations and the micro-tests allow for that.
    let single = stack.and_then(|(series, _)| in_single_precision(series));
    for item in items.iter_mut().filter(|item| is_to_be_explained(item)) {
        if micro::is_step_effect(item) {
            // What vanishes with the time step needs no place, but a name if there is one.
            item.causes = match causes.is_empty() && located.are_known {
                true => located.texts.clone(),
                false => causes.clone(),
            };
            continue;
        }
        // If the mistake is found under the declared convention, the declaration may be right. Otherwise it may be
        // wrong as well, and keeps its own causes.
        let is_declaration = item.name == micro::DECLARATION && (place > 0 || causes.is_empty());
        if !causes.is_empty() && !is_declaration {
            // What may have happened is told closer by the views of a motion that show it.
            let views =
                match item.name == invariances::NAME && causes[0].contains(events::OCCASIONS) {
                    true => std::mem::take(&mut item.causes),
                    false => Vec::new(),
                };
            item.causes = [causes.clone(), views].concat();
        } else if let Some(plain) = plain.as_ref().filter(|_| !is_declaration) {
            item.causes = vec![plain.clone()];
        } else if item.name == invariances::NAME {
            // The equations tell what is wrong, and the views of a motion where.
            let place = if located.is_known {
                located.texts.len()
            } else {
                0
            };
            item.causes
                .splice(0..0, located.texts[..place].iter().cloned());
            item.causes.extend_from_slice(&located.texts[place..]);
        } else if !located.texts.is_empty() && !is_declaration {
            item.causes.clone_from(&located.texts);
        } else if item.causes.is_empty() {
            item.causes = vec![single.clone().unwrap_or_else(|| usual(item.name))];
        }
    }
    items
}

/// Whether an item failed, or says that something vanishes with the time step.
fn is_to_be_explained(item: &Item) -> bool {
    item.outcome == Outcome::Failed || micro::is_step_effect(item)
}

fn items_of(micro: Option<&Micro>) -> Vec<Item> {
    let none = || {
        let reason = "the manifest has no task `motion`: parameters and convention of single contacts cannot be measured";
        vec![Item::not_tested(Grade::Consistency, "micro-tests", reason)]
    };
    micro.map_or_else(none, Micro::items)
}

/// The place of a mistake that is not in the table.
#[derive(Default)]
struct Located {
    texts: Vec<String>,
    /// Whether the first text names the mistake.
    is_known: bool,
    /// Whether every text names one.
    are_known: bool,
}

/// Locates a mistake that is not in the table: by the equations that fail in the micro-tests, or else by the place in
/// the stack.
fn located(known: &Known, stack: Option<Compressed>, micro: Option<&Micro>) -> Located {
    let Some(micro) = micro else {
        return Located::default();
    };
    let findings = micro.findings.findings.iter();
    let models: Vec<String> = findings.filter_map(Finding::other_model).collect();
    match failing_equations(micro, !known.others.is_empty()) {
        // What is known of the model says more than which equation fails.
        own if !models.is_empty() && !own.as_ref().is_some_and(|own| own.is_explained) => Located {
            texts: models.into_iter().take(MOST_CAUSES).collect(),
            is_known: true,
            are_known: true,
        },
        Some(own) if !own.texts.is_empty() => Located {
            texts: match own.is_explained {
                true => own.texts,
                false => {
                    let first = known.first_wrong(micro).into_iter();
                    first.chain(own.texts).take(MOST_CAUSES).collect()
                }
            },
            is_known: own.is_explained,
            are_known: own.are_explained,
        },
        _ if !known.is_exact => Located::default(),
        _ if !known.others.is_empty() => Located {
            texts: known.first_wrong(micro).into_iter().collect(),
            ..Located::default()
        },
        _ => {
            let of_stack = stack.zip(known.stacks.first());
            let beginning = of_stack.and_then(|((series, case), first)| {
                let convention = first.twin.convention;
                Evidence::of_stack(series, case, convention, false).beginning()
            });
            Located {
                texts: beginning.into_iter().collect(),
                ..Located::default()
            }
        }
    }
}

/// Returns the equations that fail in the micro-tests, and in those in which contacts come and go if these count, under
/// the convention that explains them best.
fn failing_equations(micro: &Micro, others_count: bool) -> Option<equations::Failing> {
    let others = micro.others.iter().filter(|_| others_count);
    let answers: Vec<&Answer> = micro.answers.iter().chain(others).collect();
    let leaps = (micro.findings.settled.velocity_lag - LEAPFROG_LAG).abs() < SAME_MOTION;
    let conventions = micro.conventions().into_iter();
    let is_single = !micro.findings.single.is_empty();
    let failing = conventions.map(|own| equations::failing(&answers, own, leaps, is_single));
    failing.min_by_key(|own| (!own.is_explained, own.texts.len()))
}

/// Turns an item that failed because of a valid rule into a remark. A declaration of another rule stays wrong.
fn excused(item: Item, rule: &str) -> Item {
    match item.outcome {
        Outcome::Failed if item.name == micro::DECLARATION => Item {
            causes: vec![rule.to_owned()],
            ..item
        },
        Outcome::Failed => Item::remark(item.grade, item.name, rule),
        _ => item,
    }
}

/// Returns the mistakes that explain the micro-tests of a code whose stack explodes, or else the equations that fail in
/// them.
pub(super) fn of_motions(micro: &Micro) -> Vec<String> {
    let each = micro.conventions().into_iter().map(|convention| {
        let motions: Vec<Evidence> = micro
            .answers
            .iter()
            .map(|answer| Evidence::of_motion(answer, convention))
            .collect();
        match motions.iter().any(Evidence::is_off) {
            true => search::explanations(&motions),
            false => Vec::new(),
        }
    });
    let found = each.into_iter().find(|causes| !causes.is_empty());
    found.unwrap_or_else(|| failing_equations(micro, false).map_or_else(Vec::new, |own| own.texts))
}

/// Sorts by distance, the largest first, so that a mistake that does not fit is soon rejected.
fn sort(motions: &mut [Evidence]) {
    let distance = |own: &Evidence| own.before / own.same;
    motions.sort_by(|one, two| distance(two).total_cmp(&distance(one)));
}

/// The results of a code, compared with those of its twins.
#[derive(Clone)]
struct Known {
    /// The stack up to its peak; also to its end, if law and integrator are those of the twin. None if the code
    /// compresses none.
    stacks: Vec<Evidence>,
    motions: Vec<Evidence>,
    /// Motions in which contacts come and go, if one of them shows a mistake.
    others: Vec<Evidence>,
    /// Whether the code has the integrator of the twin, by micro-tests that agree to the last digits.
    has_integrator: bool,
    /// Whether it has its law, too.
    is_exact: bool,
}

impl Known {
    fn of(stack: Option<Compressed>, micro: Option<&Micro>, convention: ContactConvention) -> Self {
        let answers = micro.map_or(&[][..], |micro| &micro.answers);
        let motions = answers.iter();
        let mut motions: Vec<Evidence> = motions
            .map(|answer| Evidence::of_motion(answer, convention))
            .collect();
        let exact = motions
            .iter()
            .filter(|own| own.before < SAME_MOTION)
            .count();
        // Some motions may be the same although the integrator is not.
        let has_integrator = exact >= MANY_EXACT;
        let is_exact = has_integrator && !micro.is_some_and(Micro::depends_on_step);
        let is_wrong = micro.is_some_and(|micro| micro.items().iter().any(is_to_be_explained));
        let part =
            |(series, case), is_whole| Evidence::of_stack(series, case, convention, is_whole);
        let mut stacks: Vec<Evidence> = stack.map(|own| part(own, false)).into_iter().collect();
        if is_exact {
            stacks.iter_mut().for_each(|own| own.same = ROUNDING);
            stacks.extend(stack.map(|own| part(own, true)));
            motions.iter_mut().for_each(|own| own.same = ROUNDING);
        } else if !is_wrong {
            // No item shows a mistake in them, so what is far from the twin comes from another integrator.
            motions.retain(|own| !own.is_off());
        }
        let others = micro.map_or(&[][..], |micro| &micro.others).iter();
        let mut others: Vec<Evidence> = others
            .map(|answer| Evidence::of_motion(answer, convention))
            .collect();
        if is_exact {
            others.iter_mut().for_each(|own| own.same = OF_THIRD_ORDER);
        }
        let differs_elsewhere = micro.is_some_and(Micro::differs_elsewhere);
        let others_are_off = differs_elsewhere || is_exact && others.iter().any(Evidence::is_off);
        others.retain(|_| others_are_off);
        sort(&mut motions);
        Self {
            stacks,
            motions,
            others,
            has_integrator,
            is_exact,
        }
    }

    /// Names the first wrong force where several contacts act at once, if motions show it there.
    fn first_wrong(&self, micro: &Micro) -> Option<String> {
        let convention = self.others.first()?.twin.convention;
        first_wrong(&micro.others, convention)
    }

    /// Returns the item on micro-tests that differ from the twin, although others agree with it to the last digits.
    fn item(&self) -> Option<Item> {
        let all = self.motions.iter().chain(&self.others);
        let off = all
            .into_iter()
            .find(|own| own.is_off() && own.same < SAME)?;
        let (name, step, found, expected) = off.first_off();
        Some(Item::failed(
            Grade::Consistency,
            "micro-tests step by step",
            format!(
                "{name} {expected:.9} at step {step} of a micro-test (native DEM, same convention)"
            ),
            format!(
                "{name} {found:.9} at step {step}, while other micro-tests agree to the last digits"
            ),
            Vec::new(),
        ))
    }

    /// Returns the mistakes that explain everything, or else the motions or the stack alone. Where there are none,
    /// contacts that come and go may show them.
    fn causes(self) -> Vec<String> {
        let causes = self.clone().explained();
        if !causes.is_empty() || self.others.is_empty() {
            return causes;
        }
        let Self {
            mut motions,
            others,
            ..
        } = self;
        motions.extend(others);
        sort(&mut motions);
        let with_others = Self {
            motions,
            others: Vec::new(),
            ..self
        };
        with_others.explained()
    }

    fn explained(self) -> Vec<String> {
        let Self {
            stacks,
            motions,
            has_integrator,
            is_exact,
            others,
        } = self;
        let law = motions.iter().any(Evidence::is_off);
        let off = stacks.iter().any(Evidence::is_off);
        let is_moved = motions.iter().any(|own| own.is_off_beside(&REPORTED));
        let mut causes = match off && !is_moved {
            true => written::explanations(&stacks[0]),
            false => Vec::new(),
        };
        // What is hardly off would hardly move a body.
        let is_clear = |own: &Evidence| own.before >= CLEARLY * own.same;
        if causes.is_empty() && law && !is_moved && is_clear(&motions[0]) {
            causes.extend(motions[0].beginning());
        }
        if !causes.is_empty() || !law && !off {
            return causes;
        }
        let all: Vec<Evidence> = motions
            .iter()
            .cloned()
            .chain(stacks.iter().cloned())
            .collect();
        causes = search::explanations(&all);
        if causes.is_empty()
            && has_integrator
            && let Some(event) = events::explanation(&stacks, &motions)
        {
            return vec![event];
        }
        if !law {
            let of_contacts = causes.iter_mut().filter(|own| search::is_of_contacts(own));
            of_contacts
                .for_each(|own| own.push_str(" (in the stack; the items on micro-tests pass)"));
        }
        if causes.is_empty() && law {
            causes = search::explanations(&motions);
        }
        if causes.is_empty() && !law && is_exact {
            // If few columns are off, they are written wrongly.
            let place = stacks[0].beginning();
            causes.extend(place.filter(|own| !own.starts_with(MOVED)));
        }
        if causes.is_empty() && !law {
            let place = match others.is_empty() {
                false => "where several contacts act at once: ",
                true => "in the stack, but not in the micro-tests: ",
            };
            causes = search::explanations(&stacks);
            causes
                .iter_mut()
                .for_each(|cause| cause.insert_str(0, place));
        }
        causes
    }
}
