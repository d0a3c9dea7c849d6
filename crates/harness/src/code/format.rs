//! The named formats of parameter files and results.

use crate::model::{Case, ContactTest, Pyramid};
use crate::series::{
    Column, ColumnSources, Header, Motion, MotionRow, PyramidRun, Sample, Series, SeriesError,
};
use schemars::JsonSchema;
use serde::Deserialize;
use serde_json::Value;

/// LIGGGHTS cuts the words of a header to this many characters.
const CUT: usize = 8;

/// How the parameters of a task are written.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum ParameterFormat {
    /// A JSON object, numbers in their shortest exact form.
    Json,
    /// The same as TOML: `name = number`, one a line, and after them the lists, one a line as well.
    Toml,
    /// Variables of LAMMPS and LIGGGHTS; of string style, because it alone passes every digit. A list has its length under
    /// its name, and each number of its entries, which count from 1, a name like `bodies_1_radius`; a word in a list is 1
    /// under a name like `features_friction`.
    LammpsVariables,
}

impl ParameterFormat {
    /// Formats `parameters`, an object of numbers and lists, as the content of their file.
    pub fn content(self, parameters: &Value) -> String {
        let entries = parameters.as_object().into_iter().flatten();
        match self {
            Self::Json => format!("{parameters:#}\n"),
            Self::Toml => {
                // What reads `name = number` line by line has every number before it meets a list.
                let (lists, numbers): (Vec<_>, Vec<_>) =
                    entries.partition(|(_, value)| value.is_array());
                let all = numbers.into_iter().chain(lists);
                all.map(|(name, value)| format!("{name} = {}\n", in_toml(value)))
                    .collect()
            }
            Self::LammpsVariables => {
                let all = entries.flat_map(|(name, value)| variables(name, value));
                all.map(|(name, number)| format!("variable {name} string {number}\n"))
                    .collect()
            }
        }
    }
}

/// Formats a value of TOML on one line, in which ` = ` stands nowhere.
fn in_toml(value: &Value) -> String {
    match value {
        Value::Array(entries) => {
            let entries: Vec<String> = entries.iter().map(in_toml).collect();
            format!("[{}]", entries.join(", "))
        }
        Value::Object(entries) => {
            let entries = entries.iter();
            let entries = entries.map(|(name, value)| format!("{name}={}", in_toml(value)));
            format!("{{{}}}", entries.collect::<Vec<_>>().join(", "))
        }
        plain => plain.to_string(),
    }
}

/// Returns the variables that stand for `value`, a parameter or a part of one, by name and number.
fn variables(name: &str, value: &Value) -> Vec<(String, String)> {
    match value {
        Value::Array(entries) => {
            let own = (1..).zip(entries).flat_map(|(number, entry)| match entry {
                Value::String(word) => vec![(format!("{name}_{word}"), "1".to_owned())],
                _ => variables(&format!("{name}_{number}"), entry),
            });
            let length = (name.to_owned(), entries.len().to_string());
            std::iter::once(length).chain(own).collect()
        }
        Value::Object(entries) => {
            let entries = entries.iter();
            let own = entries.flat_map(|(key, value)| variables(&format!("{name}_{key}"), value));
            own.collect()
        }
        number => vec![(name.to_owned(), number.to_string())],
    }
}

/// How a code writes its results.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum ResultFormat {
    /// Comma-separated columns under a header, in any order and among others.
    Csv,
    /// The last table in the log of LAMMPS or LIGGGHTS that has the columns. The header names them in full or by their
    /// first 8 characters, with or without `v_`.
    LammpsThermo,
}

impl ResultFormat {
    /// Reads the series of `case` from a result file, in which columns may have other names and factors (`sources`).
    pub fn series(
        self,
        content: &[u8],
        sources: &ColumnSources,
        case: &Case,
    ) -> Result<Series, SeriesError> {
        match self {
            Self::Csv => Series::read_from(content, sources, case),
            Self::LammpsThermo => {
                let columns = Sample::columns(case.stack.bodies);
                let (rows, absent) = last_table(content, columns, sources)?;
                Series::without(absent, rows, case)
            }
        }
    }

    /// Reads the motion of a micro-test from a result file, in which columns may have other names and factors
    /// (`sources`).
    pub fn motion(
        self,
        content: &[u8],
        sources: &ColumnSources,
        test: &ContactTest,
    ) -> Result<Motion, SeriesError> {
        let columns = MotionRow::columns(test.space.is_some());
        match self {
            Self::Csv => Motion::read_from(content, columns, sources, test.steps),
            Self::LammpsThermo => {
                let (rows, _) = last_table(content, columns, sources)?;
                Motion::new(rows, test.steps)
            }
        }
    }
}

/// Returns the rows of the last table in `log` with these `columns`, from its header to `Loop time`, and the names of
/// the columns that it lacks.
fn last_table<R: Default>(
    log: &[u8],
    columns: &'static [Column<R>],
    sources: &ColumnSources,
) -> Result<(Vec<R>, Vec<&'static str>), SeriesError> {
    let log = String::from_utf8_lossy(log);
    let lines: Vec<&str> = log.lines().collect();
    let tables = (0..lines.len()).rev().filter_map(|line| {
        let header = Header::find(columns, &header_words(lines[line]), sources, is_cut).ok()?;
        Some((line, header))
    });
    let (start, header) = tables.take(1).next().ok_or_else(|| {
        let columns = columns.iter().filter(|column| !column.is_optional);
        let columns: Vec<&str> = columns.map(|column| column.name).collect();
        let columns = columns.join(" ");
        SeriesError::absent(format!("the log has no table with the columns {columns}"))
    })?;
    let rows = lines[start + 1..]
        .iter()
        .take_while(|line| !line.starts_with("Loop time"))
        .enumerate()
        .map(|(index, line)| parse_row(&header, index + 1, line));
    let rows: Vec<R> = rows.collect::<Result<_, _>>()?;
    Ok((rows, header.absent()))
}

/// Splits a header into words, without the `v_` of variables.
fn header_words(line: &str) -> Vec<&str> {
    let words = line.split_whitespace();
    words
        .map(|word| word.strip_prefix("v_").unwrap_or(word))
        .collect()
}

fn is_cut(word: &str, name: &str) -> bool {
    Some(word) == name.get(..CUT)
}

fn parse_row<R: Default>(header: &Header<R>, row: usize, line: &str) -> Result<R, SeriesError> {
    let fields: Vec<&str> = line.split_whitespace().collect();
    let parsed = header.row(|place| fields.get(place).copied());
    parsed.map_err(|error| SeriesError::garbled(row, format!("{error} in `{line}`")))
}

/// Reads the run of `pyramid` from the log and the dump of centres that LAMMPS or LIGGGHTS leaves behind.
///
/// # Errors
/// If the log has no loop time, or the dump does not hold the cylinders of the pyramid.
pub fn pyramid_in_log(
    log: &[u8],
    dump: &[u8],
    pyramid: &Pyramid,
) -> Result<PyramidRun, SeriesError> {
    let seconds = last_loop_time(&String::from_utf8_lossy(log))?;
    let centres = centres(&String::from_utf8_lossy(dump))?;
    PyramidRun::new(centres, seconds, pyramid.cylinder_count())
}

/// Parses the seconds in the last line like `Loop time of 0.4218 on 1 procs for 2000 steps with 990 atoms`.
fn last_loop_time(log: &str) -> Result<f64, SeriesError> {
    let mut times = log
        .lines()
        .filter_map(|line| line.strip_prefix("Loop time of "));
    times
        .next_back()
        .and_then(|rest| rest.split_whitespace().next()?.parse().ok())
        .ok_or_else(|| SeriesError::absent("the log has no loop time"))
}

/// Parses the rows `id x y`, which must be in the order of the ids 1, 2, ….
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
            _ => {
                let message = format!("`{line}` in the dump of the centres is not `{row} x y`");
                Err(SeriesError::garbled(row, message))
            }
        }
    };
    (1..).zip(rows).map(row).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    const ROW: &str = "0 0 1.5e-3 0 2.7 0 1 0.9 0 -1 0.9 0 0.1 -0.02 0.1 0.02";

    fn table(log: &str) -> Result<Vec<Sample>, SeriesError> {
        last_table(log.as_bytes(), Sample::columns(2), &ColumnSources::new()).map(|(rows, _)| rows)
    }

    fn header() -> String {
        Series::COLUMNS.join(" ")
    }

    #[test]
    fn the_last_table_is_read_however_its_columns_are_named() {
        let cut = header().replace("wall_force", "wall_for");
        let prefixed = format!("v_{}", Series::COLUMNS.join(" v_"));
        for header in [header(), cut, prefixed] {
            let log =
                format!("Step KinEng\n 1 2\nLoop time of 1\n {header}\n {ROW}\nLoop time of 2\n");
            let samples = table(&log).unwrap();
            assert_eq!(samples.len(), 1);
            assert_eq!(samples[0].wall_force, 1.5e-3);
            assert_eq!(samples[0].floor[2][0], 0.02);
        }
    }

    #[test]
    fn columns_may_be_in_any_order_and_among_others() {
        let swapped = header().replace("x1 y1", "y1 v_other x1");
        let row = ROW.replacen("0 2.7", "2.7 77 0", 1);
        let samples = table(&format!("{swapped}\n{row}\n")).unwrap();
        assert_eq!(samples[0].bodies[0].position[..2], [0.0, 2.7]);
        assert_eq!(samples[0].floor[2][0], 0.02);
    }

    #[test]
    fn a_table_without_the_forces_is_none() {
        for log in [&header().replace("floor_n2", "n2"), "ERROR: Invalid model"] {
            let refusal = table(&format!("{log}\n{ROW}\n")).unwrap_err().to_string();
            let expected = "columns step time wall_force floor_n2";
            assert!(refusal.contains(expected), "{refusal}");
        }
    }

    #[test]
    fn a_row_that_is_cut_off_is_refused_with_its_number() {
        let error = table(&format!("{}\n{ROW}\n20 2 0.1 0", header())).unwrap_err();
        assert!(error.to_string().starts_with("row 2: "), "{error}");
    }

    #[test]
    fn every_format_of_parameters_holds_every_number() {
        let parameters = serde_json::json!({ "gravity": 1e-300, "steps": 3, "time_step": 0.1 });
        let toml = ParameterFormat::Toml.content(&parameters);
        let read: toml::Table = toml.parse().unwrap();
        assert_eq!(read["gravity"].as_float(), Some(1e-300));
        assert_eq!(read["steps"].as_integer(), Some(3));
        let json = ParameterFormat::Json.content(&parameters);
        assert_eq!(
            serde_json::from_str::<serde_json::Value>(&json).unwrap(),
            parameters
        );
        let variables = ParameterFormat::LammpsVariables.content(&parameters);
        assert!(variables.ends_with("variable steps string 3\nvariable time_step string 0.1\n"));
    }

    #[test]
    fn lists_come_after_the_numbers_and_have_a_line_each() {
        let bodies =
            serde_json::json!([{ "mass": 1.5, "radius": 0.1 }, { "mass": 2, "radius": 1e-300 }]);
        let parameters =
            serde_json::json!({ "bodies": bodies, "features": ["friction"], "steps": 3 });
        let toml = ParameterFormat::Toml.content(&parameters);
        assert_eq!(
            toml,
            "steps = 3\nbodies = [{mass=1.5, radius=0.1}, {mass=2, radius=1e-300}]\nfeatures = [\"friction\"]\n"
        );
        let read: toml::Table = toml.parse().unwrap();
        assert_eq!(serde_json::to_value(read).unwrap(), parameters);
        assert_eq!(
            ParameterFormat::LammpsVariables.content(&parameters),
            "variable bodies string 2\nvariable bodies_1_mass string 1.5\nvariable bodies_1_radius string 0.1\n\
             variable bodies_2_mass string 2\nvariable bodies_2_radius string 1e-300\nvariable features string 1\n\
             variable features_friction string 1\nvariable steps string 3\n"
        );
        let nothing =
            ParameterFormat::LammpsVariables.content(&serde_json::json!({ "features": [] }));
        assert_eq!(nothing, "variable features string 0\n");
    }

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
