//! A probe in which no contact acts: nothing can be measured, and there is one reason for it.

use crate::runs::Answer;
use crate::series::MotionRow;

/// Forces, torques and changes of velocity up to this are rounding: those of contacts in micro-tests are larger than 10⁻⁴.
const NOTHING: f64 = 1e-9;
/// Units of forces, torques, velocities and spins.
const OF_FORCES: [&str; 2] = ["k_n r", "k_n r²"];
const OF_VELOCITIES: [&str; 2] = ["r √(k_n/m)", "√(k_n/m)"];

/// Whether no contact acts in any of the `answers`: nothing is reported, and nothing changes a velocity but a drive.
pub(super) fn acts_nowhere(answers: &[Answer]) -> bool {
    answers.iter().all(|answer| {
        let rows = answer.motion.rows();
        let in_space = answer.test.space.is_some();
        let is_free = answer.test.drive.is_none();
        let mut columns = MotionRow::columns(in_space).iter();
        columns.all(|column| {
            let value = column.value;
            let is_nothing = |number: f64| number.abs() <= NOTHING;
            let first = rows.first().map_or(0.0, value);
            match column.unit {
                unit if OF_FORCES.contains(&unit) => rows.iter().all(|row| is_nothing(value(row))),
                unit if is_free && OF_VELOCITIES.contains(&unit) => {
                    rows.iter().all(|row| is_nothing(value(row) - first))
                }
                _ => true,
            }
        })
    })
}

/// Says that no contact acts in the micro-tests, and what may be the cause.
pub const NO_CONTACT: &str = "no contact force was seen in any of its micro-tests: every force and torque that it reports is 0, \
    and no velocity changes; usual causes: the task `motion` has no contact law for these bodies and walls, contacts \
    are not looked for before the first step, or positions and radii are in other units than those of the task";
