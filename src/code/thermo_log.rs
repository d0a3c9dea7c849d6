//! Tables in the log of LAMMPS and of LIGGGHTS, which descends from it.

use super::written::read;
use crate::model::{Case, ContactTest};
use crate::series::{Motion, Sample, Series, SeriesError};
use serde::de::DeserializeOwned;
use std::path::Path;

/// Reads the series of `case` from the log `name` in `directory`, as [`series_in_log`].
pub fn read_series(
    directory: &Path,
    name: &str,
    header: [&str; 2],
    case: &Case,
) -> Result<Series, SeriesError> {
    series_in_log(&read(directory, name)?, header, case)
}

/// Reads the motion of a micro-test in the same way.
pub fn read_motion(
    directory: &Path,
    name: &str,
    header: [&str; 2],
    test: &ContactTest,
) -> Result<Motion, SeriesError> {
    motion_in_log(&read(directory, name)?, header, test)
}

/// The series of `case` in the last table of a log of LAMMPS or LIGGGHTS whose header begins with the two
/// words `header`. Further words of the header do not count: LIGGGHTS cuts them to eight characters.
///
/// # Errors
/// If there is no such table, or it is not the series of the case.
pub fn series_in_log(log: &[u8], header: [&str; 2], case: &Case) -> Result<Series, SeriesError> {
    let samples: Vec<Sample> = last_table(&String::from_utf8_lossy(log), header)?;
    Series::new(samples, &case.protocol.schedule(), case.protocol.time_step)
}

/// The motion of a micro-test in such a table.
///
/// # Errors
/// If there is no such table, or it is not the motion of the micro-test.
pub fn motion_in_log(
    log: &[u8],
    header: [&str; 2],
    test: &ContactTest,
) -> Result<Motion, SeriesError> {
    Motion::new(
        last_table(&String::from_utf8_lossy(log), header)?,
        test.steps,
    )
}

/// The rows between the header and `Loop time`.
fn last_table<Row: DeserializeOwned>(
    log: &str,
    header: [&str; 2],
) -> Result<Vec<Row>, SeriesError> {
    let is_header = |line: &str| line.split_whitespace().take(2).eq(header);
    let lines: Vec<&str> = log.lines().collect();
    let start = lines
        .iter()
        .rposition(|line| is_header(line))
        .ok_or_else(|| SeriesError::Absent {
            message: format!(
                "the log has no table that begins with `{}`",
                header.join(" ")
            ),
        })?;
    lines[start + 1..]
        .iter()
        .take_while(|line| !line.starts_with("Loop time"))
        .enumerate()
        .map(|(index, line)| parse_row(index + 1, line))
        .collect()
}

fn parse_row<Row: DeserializeOwned>(row: usize, line: &str) -> Result<Row, SeriesError> {
    let fields: csv::StringRecord = line.split_whitespace().collect();
    fields
        .deserialize(None)
        .map_err(|error| SeriesError::Garbled {
            row,
            message: format!("{error} in `{line}`"),
        })
}

#[cfg(test)]
mod tests {
    use super::*;

    const HEADER: [&str; 2] = ["step", "time"];
    const ROW: &str = "0 0 1.5e-3 0 2.7 0 1 0.9 0 -1 0.9 0 0.1 -0.02 0.1 0.02";

    #[test]
    fn the_last_table_is_read() {
        let log = format!(
            "Step KinEng\n 1 2\nLoop time of 1\n step time wall_for\n {ROW}\nLoop time of 2\n"
        );
        let samples: Vec<Sample> = last_table(&log, HEADER).unwrap();
        assert_eq!(samples.len(), 1);
        assert_eq!(samples[0].wall_force, 1.5e-3);
        assert_eq!(samples[0].floor_t3, 0.02);
    }

    #[test]
    fn a_row_that_is_cut_off_is_refused_with_its_number() {
        let error =
            last_table::<Sample>(&format!("step time\n{ROW}\n20 2 0.1 0"), HEADER).unwrap_err();
        assert!(error.to_string().starts_with("row 2: "), "{error}");
    }

    #[test]
    fn a_log_without_a_table_is_refused() {
        assert!(last_table::<Sample>("ERROR: Invalid model", HEADER).is_err());
    }
}
