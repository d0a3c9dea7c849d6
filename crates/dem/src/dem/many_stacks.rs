//! Many stacks at once, one in each lane of the machine's vector registers.

use super::lane_group::{Lane, LaneGroup, Supervisor};
use super::lanes::{Lanes, Pair};
use super::real::Real;
use super::stack_run::{OnStack, on_stack};
use super::stack_scene::{ConventionalStack, numbers, set_numbers};
use crate::model::{Arms, Case, ContactConvention, Preparation};
use crate::series::{DropWatch, Sample, Series, SeriesError};
use pulp::Simd;
use serde::{Deserialize, Serialize};

/// A run that is not complete yet.
#[derive(Debug, Clone, PartialEq)]
pub struct OpenRun {
    /// The caller's index of the run.
    pub index: usize,
    /// The case.
    pub case: Case,
    /// State to continue from; `None` at the start. A checkpoint that does not fit the case is ignored.
    pub checkpoint: Option<Checkpoint>,
}

/// The state of a run, from which it continues with the same bits.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Checkpoint {
    /// Steps completed, from the start of the preparation.
    pub step: u64,
    /// Rows taken so far.
    pub samples: Vec<Sample>,
    /// All numbers of the scene.
    pub numbers: Vec<f64>,
}

impl Checkpoint {
    /// Whether this can be a state of a run of `case`: it must have exactly the rows that are taken before its step,
    /// and as many numbers as the scene. The values of the numbers cannot be checked, except that they must be finite.
    pub fn fits(&self, case: &Case) -> bool {
        let schedule = case.protocol.schedule();
        let done = self.step.saturating_sub(schedule.preparation.total());
        let taken = schedule.sampled_steps().take_while(|&row| row < done);
        let mut watch = DropWatch::new(schedule.stop_at_drop);
        let mut fine = self
            .samples
            .iter()
            .filter(|row| row.step >= schedule.fine_from_step);
        let is_sound =
            |row: &Sample| row.is_finite() && row.time == row.step as f64 * case.protocol.time_step;
        self.step <= schedule.total_steps()
            && self.samples.iter().map(|row| row.step).eq(taken)
            && self.samples.iter().all(is_sound)
            && !fine.any(|row| watch.has_dropped(row.wall_force))
            && self.numbers.len() == count_of_numbers(case)
            && self.numbers.iter().all(|number| number.is_finite())
    }
}

/// Returns how many numbers the scene of `case` has.
fn count_of_numbers(case: &Case) -> usize {
    struct Count;
    impl OnStack<f64> for Count {
        type Outcome = usize;

        fn on<Stack: ConventionalStack<Number = f64>>(self, stack: Stack) -> usize {
            numbers(&stack, 0).len()
        }
    }
    on_stack(case, 0.0, Count)
}

/// A source of runs, which also receives their series.
pub trait RunQueue {
    /// Returns the next run. All runs must be of the same [`LaneKind`].
    fn next(&mut self) -> Option<OpenRun>;
    /// Whether to continue; called every few milliseconds.
    fn wanted(&mut self, open: &dyn OpenRuns) -> bool;
    /// Receives the series of run `index`, truncated if the run was given up.
    fn ended(&mut self, index: usize, series: Result<Series, SeriesError>);
}

/// The runs in the lanes, by index.
pub trait OpenRuns {
    /// Steps completed by each run.
    fn steps(&self) -> Vec<(usize, u64)>;
    /// Checkpoint of each run.
    fn checkpoints(&self) -> Vec<(usize, Checkpoint)>;
}

/// The properties that all cases in the lanes of one vector must share, so that they execute the same instructions on
/// different numbers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LaneKind {
    convention: ContactConvention,
    bodies: u8,
    between_side_walls: bool,
}

impl LaneKind {
    /// The kind of `case`.
    pub fn of(case: &Case) -> Self {
        Self {
            convention: ContactConvention {
                arms: Arms::PAPER,
                restitution: 1.0,
                moment_of_inertia: 1.0,
                ..case.convention
            },
            bodies: case.stack.bodies,
            between_side_walls: matches!(case.protocol.preparation, Preparation::SideWalls(_)),
        }
    }
}

/// The number of doubles that one instruction of this machine processes.
#[derive(Debug, Clone, Copy)]
pub struct LaneWidth(Instructions);

#[derive(Debug, Clone, Copy)]
enum Instructions {
    One,
    Two,
    #[cfg(target_arch = "x86_64")]
    Avx2(pulp::x86::V3),
    #[cfg(target_arch = "x86_64")]
    Avx512(pulp::x86::V4),
}

impl LaneWidth {
    /// One run at a time, without vectors.
    pub const ONE: Self = Self(Instructions::One);

    /// Every width available on this machine, narrowest first.
    pub fn available() -> Vec<Self> {
        let mut widths = vec![Self::ONE, Self(Instructions::Two)];
        #[cfg(target_arch = "x86_64")]
        {
            let avx2 = pulp::x86::V3::try_new().map(Instructions::Avx2);
            let avx512 = pulp::x86::V4::try_new().map(Instructions::Avx512);
            widths.extend(avx2.into_iter().chain(avx512).map(Self));
        }
        widths
    }

    /// The widest available on this machine.
    pub fn widest() -> Self {
        let available = Self::available();
        available.into_iter().next_back().unwrap_or(Self::ONE)
    }

    /// Number of lanes: 8 with AVX-512, 4 with AVX2, otherwise 2 or 1.
    pub fn lanes(self) -> usize {
        match self.0 {
            Instructions::One => f64::LANES,
            Instructions::Two => Pair::LANES,
            #[cfg(target_arch = "x86_64")]
            Instructions::Avx2(_) => pulp::x86::V3::F64_LANES,
            #[cfg(target_arch = "x86_64")]
            Instructions::Avx512(_) => pulp::x86::V4::F64_LANES,
        }
    }

    /// Carries out all runs of `queue`, each in a lane, with the bits of [`compress_stack`], while they are wanted.
    ///
    /// [`compress_stack`]: super::compress_stack
    pub fn compress_stacks(self, queue: &mut impl RunQueue) {
        self.with_number(Compression(queue));
    }

    /// Does `work` with numbers that have this many lanes.
    pub(super) fn with_number<Work: OnNumber>(self, work: Work) -> Work::Outcome {
        match self.0 {
            Instructions::One => work.on(0.0),
            Instructions::Two => work.on(Pair::splat(0.0)),
            #[cfg(target_arch = "x86_64")]
            Instructions::Avx2(simd) => work.on(Lanes::splat(simd, 0.0)),
            #[cfg(target_arch = "x86_64")]
            Instructions::Avx512(simd) => work.on(Lanes::splat(simd, 0.0)),
        }
    }
}

/// Work that can be done with any number of lanes.
pub(super) trait OnNumber {
    /// The result.
    type Outcome;

    /// Does the work with numbers like `number`.
    fn on<R: Real>(self, number: R) -> Self::Outcome;
}

struct Compression<'a, Queue>(&'a mut Queue);

impl<Queue: RunQueue> OnNumber for Compression<'_, Queue> {
    type Outcome = ();

    fn on<R: Real>(self, number: R) {
        compress(number, self.0);
    }
}

fn compress<R: Real>(number: R, queue: &mut impl RunQueue) {
    let Some(first) = queue.next() else { return };
    let (case, kind) = (first.case, LaneKind::of(&first.case));
    let next = Some(first);
    on_stack(&case, number, Many { kind, next, queue });
}

impl<R: Real, Queue: RunQueue> OnStack<R> for Many<'_, Queue> {
    type Outcome = ();

    fn on<Stack: ConventionalStack<Number = R>>(mut self, stack: Stack) {
        LaneGroup::new(stack).run(&mut self);
    }
}

struct Many<'a, Queue> {
    kind: LaneKind,
    next: Option<OpenRun>,
    queue: &'a mut Queue,
}

impl<Stack: ConventionalStack, Queue: RunQueue> Supervisor<Stack> for Many<'_, Queue> {
    fn fill(&mut self, stack_of_all: &mut Stack, lane: usize) -> Option<Lane> {
        let run = self.next.take().or_else(|| self.queue.next())?;
        assert_eq!(LaneKind::of(&run.case), self.kind, "one kind for all lanes");
        let mut fresh = Stack::of_case(&run.case, stack_of_all.number());
        let kept = run.checkpoint.filter(|kept| kept.fits(&run.case));
        let (step, samples) = match kept {
            Some(checkpoint) => {
                set_numbers(&mut fresh, &checkpoint.numbers);
                (checkpoint.step, checkpoint.samples)
            }
            None => (0, Vec::new()),
        };
        stack_of_all.take_lane(lane, &fresh);
        Some(Lane::new(run.index, run.case, step, samples))
    }

    fn wanted(&mut self, stack: &Stack, lanes: &[Option<Lane>]) -> bool {
        self.queue.wanted(&Open { stack, lanes })
    }

    fn ended(&mut self, lane: Lane) {
        let series = Series::new(lane.samples, &lane.case);
        self.queue.ended(lane.index, series);
    }
}

struct Open<'a, Stack> {
    stack: &'a Stack,
    lanes: &'a [Option<Lane>],
}

impl<Stack: ConventionalStack> OpenRuns for Open<'_, Stack> {
    fn steps(&self) -> Vec<(usize, u64)> {
        let lanes = self.lanes.iter().flatten();
        lanes.map(|lane| (lane.index, lane.step)).collect()
    }

    fn checkpoints(&self) -> Vec<(usize, Checkpoint)> {
        let lanes = self.lanes.iter().enumerate();
        let lanes = lanes.filter_map(|(index, lane)| Some((index, lane.as_ref()?)));
        let checkpoints = lanes.map(|(index, lane)| {
            let checkpoint = Checkpoint {
                step: lane.step,
                samples: lane.samples.clone(),
                numbers: numbers(self.stack, index),
            };
            (lane.index, checkpoint)
        });
        checkpoints.collect()
    }
}
