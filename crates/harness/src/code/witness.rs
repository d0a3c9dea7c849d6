//! The witness of a program: the motion of one micro-test, to ten digits. Where a wrapper hides the program that
//! computes, another program inside it gives another motion.

use super::batch::Batch;
use super::definition::LONGEST_START;
use super::installation::ExternalCode;
use super::installed::RunContext;
use super::manifest::TaskKind;
use super::question::interrupt;
use crate::files::Scratch;
use crate::model::{ContactConvention, ContactTest, InitialMotion, sha256_hex};
use crate::series::{Motion, MotionRow};

/// Longest start, in seconds by the manifest, of a program whose witness is computed in every session.
const LONGEST_HEARD: f64 = 1.0;

/// Returns a micro-test of two cylinders that touch each other, the floor and the top wall; they stick, slide and are
/// damped.
pub fn witness_test(convention: ContactConvention) -> ContactTest {
    let first = InitialMotion {
        x: 0.0,
        y: 0.98,
        vx: 0.02,
        vy: -0.01,
        spin: 0.03,
    };
    let second = InitialMotion {
        x: 1.95,
        y: 0.99,
        vx: -0.01,
        vy: 0.004,
        spin: -0.005,
    };
    ContactTest {
        convention: ContactConvention {
            restitution: 0.9,
            ..convention
        },
        stiffness_ratio: 0.5,
        floor_friction: 0.3,
        cylinder_friction: 0.2,
        time_step: 0.02,
        steps: 100,
        wall_height: 1.97,
        wall_speed: 0.001,
        initial_motions: [first, second],
        drive: None,
        space: None,
    }
}

impl ExternalCode {
    /// Computes the SHA-256 of the motion to ten digits; returns `None` if the program takes too long to start, has
    /// no deck for micro-tests, or fails.
    pub(super) fn witness(&self) -> Option<String> {
        if self.definition().seconds.start > LONGEST_HEARD
            || !self.definition().runs(TaskKind::Motion)
        {
            return None;
        }
        let directory = Scratch::new().ok()?;
        let context = RunContext {
            time_limit: Some(LONGEST_START),
            ..RunContext::new(directory.path(), interrupt())
        };
        let test = witness_test(self.name.declaration().convention);
        let mut motion = None;
        let mut batch = Batch::new(
            self,
            std::slice::from_ref(&test),
            directory.path().to_owned(),
        );
        batch.run(&context, &mut |_, outcome| motion = outcome.ok());
        motion.map(|(motion, _)| digest(&motion))
    }
}

fn digest(motion: &Motion) -> String {
    let columns = MotionRow::COLUMNS.iter();
    let rows = motion.rows().iter();
    let numbers = rows.flat_map(|row| columns.clone().map(move |column| (column.value)(row)));
    // Adding zero turns -0 into 0.
    let text: String = numbers
        .map(|number| format!("{:.9e}\n", number + 0.0))
        .collect();
    sha256_hex(text.as_bytes())
}
