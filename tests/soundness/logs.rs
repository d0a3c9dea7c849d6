//! Output of LAMMPS and LIGGGHTS: tables in logs, dumps, and the versions that the programs print.

use super::scenes::{short_case, short_test};
use super::{Seed, marked, series};
use tristack::code::{ResultFormat, pyramid_in_log, version_in_answer};
use tristack::dem::{compress_stack, run_contact_test};
use tristack::model::{ContactConvention, Pyramid};
use tristack::series::{ColumnSources, Motion};

/// Separator of log and dump in an input.
const BETWEEN: u8 = 0;
const LIGGGHTS: &str = "LIGGGHTS (Version LIGGGHTS-PUBLIC ";

pub fn check(data: &[u8]) {
    let Some((&kind, log)) = data.split_first() else {
        return;
    };
    match kind % 4 {
        0 => {
            let case = short_case();
            if let Ok(series) = ResultFormat::LammpsThermo.series(log, &ColumnSources::new(), &case)
            {
                series::is_sound(&series, &case);
            }
        }
        1 => {
            let test = short_test();
            if let Ok(motion) = ResultFormat::LammpsThermo.motion(log, &ColumnSources::new(), &test)
            {
                assert_eq!(motion.rows().len() as u64, test.steps + 1);
            }
        }
        2 => check_pyramid(log),
        _ => check_version(&String::from_utf8_lossy(log)),
    }
}

fn small_pyramid() -> Pyramid {
    Pyramid::touching(2, 100.0, ContactConvention::TURNING)
}

fn check_pyramid(files: &[u8]) {
    let border = files.iter().position(|&byte| byte == BETWEEN);
    let (log, dump) = files.split_at(border.unwrap_or(files.len()));
    if let Ok(run) = pyramid_in_log(log, dump.get(1..).unwrap_or_default(), &small_pyramid()) {
        assert_eq!(run.centres().len(), 3);
        assert!(run.timed_seconds().is_finite() && run.timed_seconds() >= 0.0);
    }
}

fn check_version(answer: &str) {
    for before in [LIGGGHTS, "Yade version: "] {
        let version = version_in_answer(answer, before);
        assert!(
            !version.is_empty() && version.chars().count() <= 100,
            "{version}"
        );
        assert!(!version.contains(char::is_control), "{version:?}");
    }
}

pub fn seeds() -> Vec<Seed> {
    let series = compress_stack(&short_case(), || true).expect("a finite series");
    let csv = String::from_utf8(series.to_csv()).expect("text");
    let motion = run_contact_test(&short_test()).expect("a finite motion");
    let rows = serde_json::to_value(motion.rows()).expect("rows of numbers");
    let rows = rows.as_array().expect("rows").iter().map(|row| {
        let cells = Motion::COLUMNS.map(|name| row[name].to_string());
        cells.join(" ") + "\n"
    });
    let motion = format!(
        "LAMMPS\nv_{}\n{}Loop time of 0.1 on 1 procs\n",
        Motion::COLUMNS.join(" v_"),
        rows.collect::<String>()
    );
    let pyramid = "Loop time of 0.25 on 1 procs for 10 steps\n\0ITEM: ATOMS id x y \n1 -1 1\n2 1 1\n3 0 2.7\n";
    vec![
        (
            "series".to_owned(),
            marked(
                0,
                format!(
                    "step time\n 1 2\nLoop time of 1\n{}Loop time of 2\n",
                    csv.replace(',', " ")
                ),
            ),
        ),
        ("motion".to_owned(), marked(1, motion)),
        ("pyramid".to_owned(), marked(2, pyramid)),
        (
            "version".to_owned(),
            marked(3, format!("\n{LIGGGHTS}3.8.0, compiled 2021)\n")),
        ),
    ]
}
