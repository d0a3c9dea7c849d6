//! What LAMMPS and LIGGGHTS leave behind of a pyramid: the time of the last run in the log, and a dump of the
//! centres.

use super::written::read;
use crate::model::Pyramid;
use crate::series::{PyramidRun, SeriesError};
use std::path::Path;

const CENTRES: &str = "centres.txt";

/// Reads the run of `pyramid` from the log `name` and the dump in `directory`. The dump is the last thing that
/// the deck does, so that it is not of an earlier run if the code has succeeded.
pub fn read_pyramid(
    directory: &Path,
    name: &str,
    pyramid: &Pyramid,
) -> Result<PyramidRun, SeriesError> {
    let [log, dump] = [read(directory, name)?, read(directory, CENTRES)?];
    pyramid_in_log(&log, &dump, pyramid)
}

/// The run of `pyramid` in the log and the dump of centres that LAMMPS or LIGGGHTS leaves behind.
///
/// # Errors
/// If the log says no time, or the dump does not hold the cylinders of the pyramid.
pub fn pyramid_in_log(
    log: &[u8],
    dump: &[u8],
    pyramid: &Pyramid,
) -> Result<PyramidRun, SeriesError> {
    let seconds = last_loop_time(&String::from_utf8_lossy(log))?;
    let centres = centres(&String::from_utf8_lossy(dump))?;
    PyramidRun::new(centres, seconds, pyramid.cylinder_count())
}

/// Seconds in `Loop time of 0.4218 on 1 procs for 2000 steps with 990 atoms`.
fn last_loop_time(log: &str) -> Result<f64, SeriesError> {
    let mut times = log
        .lines()
        .filter_map(|line| line.strip_prefix("Loop time of "));
    times
        .next_back()
        .and_then(|rest| rest.split_whitespace().next()?.parse().ok())
        .ok_or_else(|| SeriesError::Absent {
            message: "the log says no loop time".to_owned(),
        })
}

/// The rows `id x y`, in the order of the ids 1, 2, ….
fn centres(dump: &str) -> Result<Vec<[f64; 2]>, SeriesError> {
    let mut rows = dump
        .lines()
        .skip_while(|line| !line.starts_with("ITEM: ATOMS"));
    rows.next();
    let row = |(row, line): (usize, &str)| {
        let mut fields = line.split_whitespace();
        let id = fields.next().and_then(|id| id.parse().ok());
        let mut coordinate = || fields.next()?.parse().ok();
        match (coordinate(), coordinate()) {
            (Some(x), Some(y)) if id == Some(row) => Ok([x, y]),
            _ => Err(SeriesError::Garbled {
                row,
                message: format!("`{line}` in {CENTRES} is not `{row} x y`"),
            }),
        }
    };
    (1..).zip(rows).map(row).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_last_loop_time_counts() {
        let log = "Loop time of 3 on 1 procs\nLoop time of 0.25 on 1 procs for 10 steps\n";
        assert_eq!(last_loop_time(log).unwrap(), 0.25);
        assert!(last_loop_time("ERROR: Lost atoms").is_err());
    }

    #[test]
    fn centres_are_read_in_order_and_nothing_else_is() {
        let dump = "ITEM: NUMBER OF ATOMS\n2\nITEM: ATOMS id x y \n1 -1 0.5 \n2 1 0.5 \n";
        assert_eq!(centres(dump).unwrap(), [[-1.0, 0.5], [1.0, 0.5]]);
        for garbled in ["2 -1 0.5", "1 -1", "1 a b"] {
            let error = centres(&format!("ITEM: ATOMS id x y\n{garbled}")).unwrap_err();
            assert!(error.to_string().starts_with("row 1: "), "{error}");
        }
    }
}
