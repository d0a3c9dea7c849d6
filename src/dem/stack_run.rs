//! The three-cylinder stack: prepared, compressed, sampled.

use super::contact::{ContactModel, ConventionalModel, SpringDashpot};
use super::double_double::DoubleDouble;
use super::lane_group::{Lane, LaneGroup, Supervisor};
use super::power_law::PowerLaw;
use super::real::Real;
use super::stack_scene::StackScene;
use crate::model::Case;
use crate::series::{Series, SeriesError};

/// Prepares and compresses the stack of `case`, and samples the compression as planned. The run is given up once
/// `wanted` is false.
///
/// # Errors
/// If the motion leaves the finite numbers, or the run is given up.
pub fn compress_stack(case: &Case, wanted: impl Fn() -> bool) -> Result<Series, SeriesError> {
    match case.convention.law.is_linear() {
        true => compress_stack_with::<SpringDashpot<f64>>(case, law(case, 0.0), wanted),
        false => compress_stack_with::<PowerLaw<f64>>(case, law(case, 0.0), wanted),
    }
}

/// The same in double-double arithmetic, 106 bits, at some forty times the cost: the difference from [`compress_stack`]
/// is the round-off of the latter.
///
/// # Errors
/// If the motion leaves the finite numbers, or the run is given up.
pub fn compress_stack_precisely(
    case: &Case,
    wanted: impl Fn() -> bool,
) -> Result<Series, SeriesError> {
    match case.convention.law.is_linear() {
        true => precisely::<SpringDashpot<_>>(case, wanted),
        false => precisely::<PowerLaw<_>>(case, wanted),
    }
}

fn precisely<Model: ConventionalModel<DoubleDouble>>(
    case: &Case,
    wanted: impl Fn() -> bool,
) -> Result<Series, SeriesError> {
    let zero = DoubleDouble::new(0.0);
    compress_stack_watched(case, (law::<_, Model>(case, zero), zero), wanted, |_| ())
}

/// The contact law of `case`, in numbers like `number`.
pub(super) fn law<R: Real, Model: ConventionalModel<R>>(case: &Case, number: R) -> Model {
    Model::of_convention(number, &case.convention, case.stack.stiffness_ratio)
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
    compress_stack_watched(case, (model, 0.0), wanted, |_| ())
}

/// Like [`compress_stack`], in numbers like `number`; `watch` receives every sampled state.
pub(super) fn compress_stack_watched<R: Real, Model: ContactModel<R>>(
    case: &Case,
    (model, number): (Model, R),
    wanted: impl Fn() -> bool,
    watch: impl FnMut(&StackScene<R, Model>),
) -> Result<Series, SeriesError> {
    let mut single = Single {
        case: Some(*case),
        wanted,
        watch,
        samples: Vec::new(),
    };
    LaneGroup::new(StackScene::of(case, model, number)).run(&mut single);
    Series::new(single.samples, &case.protocol)
}

/// Supervises the one run of a stack.
struct Single<Wanted, Watch> {
    case: Option<Case>,
    wanted: Wanted,
    watch: Watch,
    samples: Vec<crate::series::Sample>,
}

impl<R, Model, Wanted, Watch> Supervisor<R, Model> for Single<Wanted, Watch>
where
    R: Real,
    Model: ContactModel<R>,
    Wanted: Fn() -> bool,
    Watch: FnMut(&StackScene<R, Model>),
{
    fn fill(&mut self, _: &mut StackScene<R, Model>, _: usize) -> Option<Lane> {
        let case = self.case.take()?;
        Some(Lane::new(0, case, 0, Vec::new()))
    }

    fn wanted(&mut self, _: &StackScene<R, Model>, _: &[Option<Lane>]) -> bool {
        (self.wanted)()
    }

    fn sampled(&mut self, stack: &StackScene<R, Model>) {
        (self.watch)(stack);
    }

    fn ended(&mut self, lane: Lane) {
        self.samples = lane.samples;
    }
}
