//! Series and motions in CSV, and everything that is made of a series: what YADE delivers, and what the store
//! keeps of every code.

use super::scenes::{case_with_shortcuts, short_case, short_test};
use super::{Seed, marked};
use tristack::dem::{compress_stack, run_contact_test};
use tristack::model::Case;
use tristack::output::{run_svg, vtk_series};
use tristack::series::{Frames, Motion, Series, YieldEstimates};

/// A picture of a wide stack takes some 100 kB.
const LARGEST_PICTURE: usize = 1_000_000;

pub fn check(data: &[u8]) {
    let Some((&kind, text)) = data.split_first() else {
        return;
    };
    match kind % 4 {
        0 => check_series(text, &short_case()),
        1 => check_series(text, &case_with_shortcuts()),
        3 => check_unplanned(text),
        _ => check_motion(text),
    }
}

fn check_series(text: &[u8], case: &Case) {
    match Series::read(text, case) {
        Ok(series) => {
            let again = Series::read(&series.to_csv()[..], case);
            assert_eq!(again.expect("its own CSV is a series"), series);
            is_sound(&series, case);
            // Pictures take a hundred times longer.
            if text.len().is_multiple_of(16) {
                can_be_drawn(&series, case);
            }
        }
        Err(refusal) => assert!(!refusal.to_string().is_empty()),
    }
}

/// An accepted series has a time step, and can be read.
fn check_unplanned(text: &[u8]) {
    match Series::read_unplanned(text, 2) {
        Ok((series, time_step)) => {
            assert!(time_step > 0.0);
            let rows = series.samples();
            assert!(rows.is_sorted_by(|one, other| one.step < other.step));
            assert!(rows.iter().all(|row| row.wall_force.is_finite()));
            YieldEstimates::read(&series, &short_case());
        }
        Err(refusal) => assert!(!refusal.to_string().is_empty()),
    }
}

/// An accepted series is finite, lies at the planned steps, and can be read.
pub fn is_sound(series: &Series, case: &Case) {
    let planned = case.protocol.schedule();
    let rows = series.samples();
    assert!(rows.len() as u64 <= planned.rows());
    assert!(
        rows.iter()
            .zip(planned.sampled_steps())
            .all(|(row, step)| row.step == step)
    );
    let finite = |value: f64| value.is_finite();
    let has_heights = !series.absent().contains(&"y1");
    assert!(rows.iter().all(|row| finite(row.wall_force)
        && finite(row.floor[2][0])
        && finite(row.bodies[0].position[1]) == has_heights));
    let estimates = YieldEstimates::read(series, case);
    assert!(
        estimates
            .sliding_friction
            .is_none_or(|friction| friction > 0.0)
    );
}

fn can_be_drawn(series: &Series, case: &Case) {
    let Ok(frames) = Frames::of_series(series, case) else {
        assert!(!series.absent().is_empty());
        return;
    };
    assert!(run_svg("yade", case, &frames).len() < LARGEST_PICTURE);
    assert_eq!(
        vtk_series(&frames, &case.stack).len(),
        2 * series.samples().len() + 1
    );
}

fn check_motion(text: &[u8]) {
    let steps = short_test().steps;
    if let Ok(motion) = Motion::read(text, steps) {
        let rows = motion.rows();
        assert_eq!(rows.len() as u64, steps + 1);
        assert!(
            rows.iter()
                .all(|row| row.torque2.is_finite() && row.x1.is_finite())
        );
    }
}

pub fn seeds() -> Vec<Seed> {
    let series = |case: &Case| {
        let series = compress_stack(case, || true).expect("a finite series");
        series.to_csv()
    };
    vec![
        ("series".to_owned(), marked(0, series(&short_case()))),
        (
            "shortcuts".to_owned(),
            marked(1, series(&case_with_shortcuts())),
        ),
        ("motion".to_owned(), marked(2, motion_csv())),
        ("unplanned".to_owned(), marked(3, series(&short_case()))),
        ("forces".to_owned(), marked(0, forces_alone())),
    ]
}

/// A series without positions and angles, in another order and with a column of its own.
fn forces_alone() -> String {
    let series = compress_stack(&short_case(), || true).expect("a finite series");
    let rows = series.samples().iter().map(|row| {
        let floor = [
            row.floor[1][1],
            row.floor[1][0],
            row.floor[2][1],
            row.floor[2][0],
        ];
        let floor = floor.map(|force| force.to_string()).join(",");
        format!("{floor},7,{},{},{}\n", row.wall_force, row.time, row.step)
    });
    let header = "floor_n2,floor_t2,floor_n3,floor_t3,energy,wall_force,time,step\n";
    header.to_owned() + &rows.collect::<String>()
}

/// The motion of the short test, comma by comma.
fn motion_csv() -> String {
    let motion = run_contact_test(&short_test()).expect("a finite motion");
    let rows = serde_json::to_value(motion.rows()).expect("rows of numbers");
    let rows = rows.as_array().expect("rows");
    let header = Motion::COLUMNS.join(",") + "\n";
    let lines = rows.iter().map(|row| {
        let cells = Motion::COLUMNS.map(|name| row[name].to_string());
        cells.join(",") + "\n"
    });
    header + &lines.collect::<String>()
}
