//! Runs of the stack: preparation, compression and sampling.

use super::contact::{ContactModel, ConventionalModel, SpringDashpot};
use super::double_double::DoubleDouble;
use super::geometry::Space;
use super::lane_group::{Lane, LaneGroup, Supervisor};
use super::power_law::PowerLaw;
use super::real::Real;
use super::stack_scene::{ConventionalStack, LoadedStack, SphereScene, StackScene};
use crate::model::Case;
use crate::series::{Series, SeriesError};

/// Work on the scene of a case, generic over the scene.
pub(super) trait OnStack<R: Real> {
    /// The result.
    type Outcome;

    /// Does the work on `stack`, the scene of the case at the start of its preparation.
    fn on<Stack: ConventionalStack<Number = R>>(self, stack: Stack) -> Self::Outcome;
}

/// Does `work` on the scene of `case` in numbers like `number`.
pub(super) fn on_stack<R: Real, Work: OnStack<R>>(
    case: &Case,
    number: R,
    work: Work,
) -> Work::Outcome {
    match case.convention.law.is_linear() {
        true => on_stack_with::<R, SpringDashpot<R>, Work>(case, number, work),
        false => on_stack_with::<R, PowerLaw<R>, Work>(case, number, work),
    }
}

fn on_stack_with<R, Model, Work>(case: &Case, number: R, work: Work) -> Work::Outcome
where
    R: Real,
    Model: ConventionalModel<R> + ConventionalModel<R, Space>,
    Work: OnStack<R>,
{
    match case.stack.bodies {
        2 => work.on(StackScene::<R, Model>::of_case(case, number)),
        _ => work.on(SphereScene::<R, Model>::of_case(case, number)),
    }
}

/// Prepares and compresses the stack of `case`, and samples the compression as its protocol plans. The run is given up
/// once `wanted` returns false.
///
/// # Errors
/// If the motion leaves the finite numbers, or the run is given up.
pub fn compress_stack(case: &Case, wanted: impl Fn() -> bool) -> Result<Series, SeriesError> {
    on_stack(case, 0.0, Compress { case, wanted })
}

/// Compresses the stack in double-double arithmetic with 106 bits, at some forty times the cost. The difference from
/// [`compress_stack`] is the round-off of the latter.
///
/// # Errors
/// If the motion leaves the finite numbers, or the run is given up.
pub fn compress_stack_precisely(
    case: &Case,
    wanted: impl Fn() -> bool,
) -> Result<Series, SeriesError> {
    on_stack(case, DoubleDouble::new(0.0), Compress { case, wanted })
}

struct Compress<'a, Wanted> {
    case: &'a Case,
    wanted: Wanted,
}

impl<R: Real, Wanted: Fn() -> bool> OnStack<R> for Compress<'_, Wanted> {
    type Outcome = Result<Series, SeriesError>;

    fn on<Stack: ConventionalStack<Number = R>>(self, stack: Stack) -> Self::Outcome {
        compress_stack_watched(self.case, stack, self.wanted, |_| ())
    }
}

/// Like [`compress_stack`], with any contact law.
///
/// # Errors
/// If the motion leaves the finite numbers, or the run is given up.
pub fn compress_stack_with<Model: ContactModel<f64>>(
    case: &Case,
    model: Model,
    wanted: impl Fn() -> bool,
) -> Result<Series, SeriesError> {
    compress_stack_watched(case, StackScene::of(case, model, 0.0), wanted, |_| ())
}

/// Like [`compress_stack`], for a `stack` at the start of its preparation; `watch` receives every sampled state.
pub(super) fn compress_stack_watched<Stack: LoadedStack>(
    case: &Case,
    stack: Stack,
    wanted: impl Fn() -> bool,
    watch: impl FnMut(&Stack),
) -> Result<Series, SeriesError> {
    let mut single = Single {
        case: Some(*case),
        wanted,
        watch,
        samples: Vec::new(),
    };
    LaneGroup::new(stack).run(&mut single);
    Series::new(single.samples, case)
}

/// Supervisor of a single run.
struct Single<Wanted, Watch> {
    case: Option<Case>,
    wanted: Wanted,
    watch: Watch,
    samples: Vec<crate::series::Sample>,
}

impl<Stack, Wanted, Watch> Supervisor<Stack> for Single<Wanted, Watch>
where
    Wanted: Fn() -> bool,
    Watch: FnMut(&Stack),
{
    fn fill(&mut self, _: &mut Stack, _: usize) -> Option<Lane> {
        let case = self.case.take()?;
        Some(Lane::new(0, case, 0, Vec::new()))
    }

    fn wanted(&mut self, _: &Stack, _: &[Option<Lane>]) -> bool {
        (self.wanted)()
    }

    fn sampled(&mut self, stack: &Stack) {
        (self.watch)(stack);
    }

    fn ended(&mut self, lane: Lane) {
        self.samples = lane.samples;
    }
}
