//! LIGGGHTS: one process a case, the series in the last table of its log.

use super::EngineName;
use super::deck::DeckParameters;
use super::external::Adapter;
use crate::stack::{Case, Convention};
use crate::trace::{Sample, SeriesError, Trace};
use std::path::Path;

/// Both arms end halfway into the overlap.
pub const CONVENTION: Convention = Convention::with_arms(-0.5, -0.5);

const LOG: &str = "log.liggghts";

/// LIGGGHTS, pair_style gran hooke/stiffness with tangential history, mesh wall on top.
pub static LIGGGHTS: Adapter = Adapter {
    name: EngineName::Liggghts,
    program: "liggghts",
    // Without a deck to read it prints its banner and ends.
    version_arguments: &["-in", "/dev/null", "-log", "none"],
    deck: &[
        ("stack.in", include_str!("../../liggghts_inputs/stack.in")),
        ("wall.stl", include_str!("../../liggghts_inputs/wall.stl")),
    ],
    // Without these Open MPI spends 0.3 s a start on looking for a network.
    environment: &[
        ("OMPI_MCA_ess_singleton_isolated", "1"),
        ("OMPI_MCA_pml", "ob1"),
    ],
    logs: &[LOG],
    parameter_file: "parameters.in",
    parameters: DeckParameters::to_liggghts,
    arguments: |_| ["-in", "stack.in", "-log", LOG].map(str::to_owned).to_vec(),
    completion_file: None,
    read_series,
};

fn read_series(directory: &Path, case: &Case) -> Result<Trace, SeriesError> {
    let log = std::fs::read(directory.join(LOG)).map_err(|error| SeriesError::Absent {
        message: format!("cannot read {LOG}: {error}"),
    })?;
    let samples = last_table(&String::from_utf8_lossy(&log))?;
    Trace::new(samples, &case.protocol.schedule(), case.protocol.time_step)
}

/// The rows between the header `step time …` and `Loop time`. LIGGGHTS shortens the names of columns to
/// eight characters, so that the header is recognised by its first two.
fn last_table(log: &str) -> Result<Vec<Sample>, SeriesError> {
    let is_header = |line: &str| line.split_whitespace().take(2).eq(["step", "time"]);
    let lines: Vec<&str> = log.lines().collect();
    let header = lines
        .iter()
        .rposition(|line| is_header(line))
        .ok_or_else(|| SeriesError::Absent {
            message: format!("{LOG} has no table that begins with `step time`"),
        })?;
    lines[header + 1..]
        .iter()
        .take_while(|line| !line.starts_with("Loop time"))
        .enumerate()
        .map(|(index, line)| parse_row(index + 1, line))
        .collect()
}

fn parse_row(row: usize, line: &str) -> Result<Sample, SeriesError> {
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

    const ROW: &str = "0 0 1.5e-3 0 2.7 0 1 0.9 0 -1 0.9 0 0.1 -0.02 0.1 0.02";

    #[test]
    fn the_last_table_is_read() {
        let log = format!(
            "Step KinEng\n 1 2\nLoop time of 1\n step time wall_for\n {ROW}\nLoop time of 2\n"
        );
        let samples = last_table(&log).unwrap();
        assert_eq!(samples.len(), 1);
        assert_eq!(samples[0].wall_force, 1.5e-3);
        assert_eq!(samples[0].floor_t3, 0.02);
    }

    #[test]
    fn a_row_that_is_cut_off_is_refused_with_its_number() {
        let error = last_table(&format!("step time\n{ROW}\n20 2 0.1 0")).unwrap_err();
        assert!(error.to_string().starts_with("row 2: "), "{error}");
    }

    #[test]
    fn a_log_without_a_table_is_refused() {
        assert!(last_table("ERROR: Invalid model").is_err());
    }
}
