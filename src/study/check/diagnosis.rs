//! The items on a stack and on micro-tests, and the one mistake that explains what failed among them.

use super::evidence::{Evidence, ROUNDING};
use super::micro::{self, Micro};
use super::report::{Grade, Item, Outcome};
use super::stack::{self, at_first_sight};
use super::table::usual;
use super::{search, written};
use crate::model::{Case, ContactConvention};
use crate::series::Series;

/// Largest distance of motions that have the same law and integrator: rounding, which single contacts do not amplify.
const SAME_MOTION: f64 = 1e-9;

/// The items on the `series` of `case`, and on the micro-tests where there are any; what failed is explained by the
/// mistake that gives all of it, else by itself, else by what is usual.
pub(super) fn items(series: &Series, case: &Case, micro: Option<&Micro>) -> Vec<Item> {
    let of_micro = micro.map_or_else(
        || {
            vec![Item::not_tested(
                Grade::Consistency,
                "micro-tests",
                "the manifest has no task `motion`: parameters and convention of single contacts cannot be measured",
            )]
        },
        Micro::items,
    );
    let conventions = micro.map_or_else(|| vec![case.convention], Micro::conventions);
    let convention = conventions.last().copied().unwrap_or(case.convention);
    let known = Known::of(Some(series), case, micro, convention);
    let mut items = match &known.stack {
        Some(own) => stack::items(series, case, own),
        None => Vec::new(),
    };
    items.extend(of_micro);
    if !items.iter().any(|item| item.outcome == Outcome::Failed) {
        return items;
    }
    let found = conventions
        .into_iter()
        .enumerate()
        .find_map(|(place, convention)| {
            let causes = Known::of(Some(series), case, micro, convention).causes();
            (!causes.is_empty()).then_some((place, causes))
        });
    let (place, causes) = found.unwrap_or_default();
    let plain = at_first_sight(series);
    for item in items
        .iter_mut()
        .filter(|item| item.outcome == Outcome::Failed)
    {
        // Beside a mistake the declaration may be right, or wrong as well.
        let is_declaration = item.name == micro::DECLARATION && (place > 0 || causes.is_empty());
        if !causes.is_empty() && !is_declaration {
            item.causes.clone_from(&causes);
        } else if let Some(plain) = plain.as_ref().filter(|_| !is_declaration) {
            item.causes = vec![plain.clone()];
        } else if item.causes.is_empty() {
            item.causes = vec![usual(item.name)];
        }
    }
    items
}

/// The mistakes that explain the micro-tests of a code whose stack explodes.
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
    each.into_iter()
        .find(|causes| !causes.is_empty())
        .unwrap_or_default()
}

/// What a code has written, beside its twins.
struct Known {
    stack: Option<Evidence>,
    motions: Vec<Evidence>,
}

impl Known {
    fn of(
        series: Option<&Series>,
        case: &Case,
        micro: Option<&Micro>,
        convention: ContactConvention,
    ) -> Self {
        let answers = micro.map_or(&[][..], |micro| &micro.answers);
        let mut motions: Vec<Evidence> = answers
            .iter()
            .map(|answer| Evidence::of_motion(answer, convention))
            .collect();
        // In order of what they show, so that what does not fit is soon seen.
        motions.sort_by(|one, two| two.before.total_cmp(&one.before));
        let is_exact = motions
            .first()
            .is_some_and(|worst| worst.before < SAME_MOTION);
        let is_right = micro.is_some_and(|micro| {
            !micro
                .items()
                .iter()
                .any(|item| item.outcome == Outcome::Failed)
        });
        if !is_exact && is_right {
            // Another integrator.
            motions.clear();
        }
        let mut stack = series.map(|series| Evidence::of_stack(series, case, convention));
        if let Some(own) = stack.as_mut().filter(|_| is_exact) {
            own.same = ROUNDING;
        }
        Self { stack, motions }
    }

    /// The mistakes that explain everything, or else the motions, or else the stack.
    fn causes(self) -> Vec<String> {
        let Self { stack, motions } = self;
        let law = motions.iter().any(Evidence::is_off);
        let off = stack.iter().any(Evidence::is_off);
        let mut causes = match &stack {
            Some(stack) if off && !law => written::explanations(stack),
            _ => Vec::new(),
        };
        if causes.is_empty() && (law || off) {
            let all: Vec<Evidence> = motions.iter().cloned().chain(stack).collect();
            causes = search::explanations(&all);
        }
        if causes.is_empty() && law {
            causes = search::explanations(&motions);
        }
        causes
    }
}
