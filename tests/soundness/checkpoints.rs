//! Checkpoints of native runs: one that does not fit its case is not believed, and one that does never panics.

use super::{Seed, marked, scenes};
use std::sync::LazyLock;
use tristack::dem::{Checkpoint, LaneWidth, OpenRun, OpenRuns, RunQueue};
use tristack::model::{Case, Preparation};
use tristack::series::{Series, SeriesError};

/// Bytes of one change: what (1), which (2), the new number (8).
const CHANGE: usize = 11;

/// A run with a checkpoint in its last steps. (There is one after each 65536 steps.)
static KEPT: LazyLock<(Case, Checkpoint)> = LazyLock::new(|| {
    let mut case = scenes::short_case();
    case.protocol.preparation = Preparation::GravityRamp {
        ramp_time: 6400.0,
        rest_time: 130.0,
    };
    let mut queue = Queue::with(case, None);
    LaneWidth::ONE.compress_stacks(&mut queue);
    let kept = queue.checkpoint.expect("a checkpoint");
    (case, kept)
});

/// Hands out one run.
struct Queue {
    run: Option<OpenRun>,
    /// The last that was taken.
    checkpoint: Option<Checkpoint>,
    series: Vec<Result<Series, SeriesError>>,
}

impl Queue {
    fn with(case: Case, checkpoint: Option<Checkpoint>) -> Self {
        let run = OpenRun {
            index: 0,
            case,
            checkpoint,
        };
        Self {
            run: Some(run),
            checkpoint: None,
            series: Vec::new(),
        }
    }
}

impl RunQueue for Queue {
    fn next(&mut self) -> Option<OpenRun> {
        self.run.take()
    }

    fn wanted(&mut self, open: &dyn OpenRuns) -> bool {
        self.checkpoint = open.checkpoints().pop().map(|(_, checkpoint)| checkpoint);
        true
    }

    fn ended(&mut self, _: usize, series: Result<Series, SeriesError>) {
        self.series.push(series);
    }
}

/// A checkpoint as JSON, or changes of a right one.
pub fn check(data: &[u8]) {
    let Some((&kind, rest)) = data.split_first() else {
        return;
    };
    let checkpoint = match kind % 2 {
        0 => serde_json::from_slice(rest).ok(),
        _ => Some(changed(rest)),
    };
    // A checkpoint that does not fit starts the run anew, which would take too long here; see tests/commands/interruption.rs.
    let late = |kept: &Checkpoint| kept.step >= KEPT.1.step;
    if let Some(checkpoint) = checkpoint.filter(|kept| kept.fits(&KEPT.0) && late(kept)) {
        let _ = resume(checkpoint);
    }
}

/// Goes on from `checkpoint` to the end.
fn resume(checkpoint: Checkpoint) -> Result<Series, SeriesError> {
    let mut queue = Queue::with(KEPT.0, Some(checkpoint));
    LaneWidth::ONE.compress_stacks(&mut queue);
    assert_eq!(queue.series.len(), 1, "a run ends once");
    queue.series.remove(0)
}

fn changed(data: &[u8]) -> Checkpoint {
    let mut checkpoint = KEPT.1.clone();
    for change in data.chunks_exact(CHANGE) {
        let which = usize::from(u16::from_le_bytes([change[1], change[2]]));
        let bytes: [u8; 8] = change[3..].try_into().expect("eight bytes");
        change_one(&mut checkpoint, change[0], which, bytes);
    }
    checkpoint
}

fn change_one(checkpoint: &mut Checkpoint, what: u8, which: usize, bytes: [u8; 8]) {
    let (count, rows) = (checkpoint.numbers.len(), checkpoint.samples.len());
    match what % 6 {
        0 => checkpoint.step = u64::from_le_bytes(bytes),
        1 => checkpoint.step = checkpoint.step.wrapping_add(which as u64),
        2 if count > 0 => checkpoint.numbers[which % count] = f64::from_le_bytes(bytes),
        3 => checkpoint.numbers.truncate(which),
        4 if rows > 0 => checkpoint.samples[which % rows].wall_force = f64::from_le_bytes(bytes),
        5 if rows > 0 => checkpoint.samples[which % rows].step = u64::from_le_bytes(bytes),
        _ => checkpoint.samples.truncate(which),
    }
}

pub fn seeds() -> Vec<Seed> {
    let json = serde_json::to_vec(&KEPT.1).expect("plain data");
    let mut cut = KEPT.1.clone();
    cut.samples.clear();
    let cut = serde_json::to_vec(&cut).expect("plain data");
    vec![
        ("right".to_owned(), marked(0, json)),
        ("no-rows".to_owned(), marked(0, cut)),
        (
            "number".to_owned(),
            marked(1, [2, 7, 0, 0, 0, 0, 0, 0, 0, 240, 63]),
        ),
        (
            "step".to_owned(),
            marked(1, [1, 7, 0, 0, 0, 0, 0, 0, 0, 0, 0]),
        ),
    ]
}
