//! The header of a result file: columns in any order, possibly under other names and with factors.

use super::SeriesError;
use super::column::Column;
use crate::model::readable;
use std::collections::BTreeMap;
use std::io::Read;

/// Where a declared column is found in a result: under another name, or in another unit or direction.
#[derive(Debug, Clone, PartialEq)]
pub struct ColumnSource {
    /// Name of the column in the result.
    pub from: String,
    /// Factor by which its values are multiplied.
    pub factor: f64,
}

/// The columns of a result that differ from their declaration, by declared name.
pub type ColumnSources = BTreeMap<String, ColumnSource>;

/// Whether a word of the header matches a name.
pub(crate) type SameName = fn(&str, &str) -> bool;

/// The places of the columns of `R` in a file.
pub struct Header<R: 'static> {
    /// Column, position and factor.
    present: Vec<(&'static Column<R>, usize, f64)>,
    /// The columns that the file leaves out.
    absent: Vec<&'static Column<R>>,
}

impl<R: Default> Header<R> {
    /// Finds the `columns` among the `words` of a header; other words are ignored.
    ///
    /// # Errors
    /// If a column is missing that must be there, or stands there twice.
    pub fn find(
        columns: &'static [Column<R>],
        words: &[&str],
        sources: &ColumnSources,
        is_same: SameName,
    ) -> Result<Self, SeriesError> {
        let mut header = Self {
            present: Vec::new(),
            absent: Vec::new(),
        };
        for column in columns {
            let source = sources.get(column.name);
            let name = source.map_or(column.name, |source| &source.from);
            match place(words, name, is_same) {
                Ok(Some(place)) => {
                    let factor = source.map_or(1.0, |source| source.factor);
                    header.present.push((column, place, factor));
                }
                // A column that the manifest renames must be present.
                Ok(None) if column.is_optional && source.is_none() => header.absent.push(column),
                Ok(None) => return Err(refused(words, format!("`{name}` is missing"))),
                Err(()) => return Err(refused(words, format!("`{name}` is there twice"))),
            }
        }
        Ok(header)
    }

    /// Builds a row from the `field`s at the positions of the columns.
    ///
    /// # Errors
    /// The message about a field that is missing or no number.
    pub fn row<'a>(&self, field: impl Fn(usize) -> Option<&'a str>) -> Result<R, String> {
        let mut row = R::default();
        for column in &self.absent {
            (column.set)(&mut row, f64::NAN);
        }
        for (column, place, factor) in &self.present {
            let name = column.name;
            let text = field(*place).ok_or_else(|| format!("`{name}` is missing"))?;
            let number: Option<f64> = text.trim().parse().ok();
            if !number.is_some_and(|number| (column.set)(&mut row, factor * number)) {
                let why = why_no_number(text);
                return Err(format!(
                    "`{name}` is `{text}`, which is no number for it{why}"
                ));
            }
        }
        Ok(row)
    }

    /// Names of the columns that the file leaves out.
    pub fn absent(self) -> Vec<&'static str> {
        self.absent.iter().map(|column| column.name).collect()
    }
}

/// Says why a text is no number, if it is what Fortran writes.
fn why_no_number(text: &str) -> &'static str {
    let text = text.trim();
    let with_e = text.replace(['d', 'D'], "e");
    if !text.is_empty() && text.bytes().all(|byte| byte == b'*') {
        ": the number did not fit its format, which wants more digits"
    } else if with_e != text && with_e.parse::<f64>().is_ok() {
        ": an exponent is written with E, as 1.0E+03"
    } else {
        ""
    }
}

/// Returns the only position of `name` among `words`: an exact match, or else a word that `is_same`. An error if there
/// are two.
fn place(words: &[&str], name: &str, is_same: SameName) -> Result<Option<usize>, ()> {
    for same in [|word: &str, name: &str| word == name, is_same] {
        let mut places = (0..words.len()).filter(|&place| same(words[place], name));
        match (places.next(), places.next()) {
            (found @ Some(_), None) => return Ok(found),
            (None, _) => {}
            (Some(_), Some(_)) => return Err(()),
        }
    }
    Ok(None)
}

fn refused(words: &[&str], problem: String) -> SeriesError {
    SeriesError::Columns {
        found: readable(&words.join(",")),
        problem: readable(&problem),
    }
}

/// Returns the rows of a CSV file, at most `limit`, and the names of the columns that it leaves out.
pub(super) fn csv_rows<R: Default>(
    input: impl Read,
    columns: &'static [Column<R>],
    sources: &ColumnSources,
    limit: usize,
) -> Result<(Vec<R>, Vec<&'static str>), SeriesError> {
    let mut reader = csv::ReaderBuilder::new()
        .trim(csv::Trim::Headers)
        .from_reader(input);
    let words = reader.headers();
    let words = words.map_err(|error| SeriesError::garbled(0, error))?;
    let words: Vec<&str> = words.iter().collect();
    let header = Header::find(columns, &words, sources, |word, name| word == name)?;
    let mut record = csv::StringRecord::new();
    let mut rows = Vec::new();
    while rows.len() < limit {
        let garbled = |message: String| SeriesError::garbled(rows.len() + 1, message);
        match reader.read_record(&mut record) {
            Ok(true) => rows.push(header.row(|place| record.get(place)).map_err(garbled)?),
            Ok(false) => break,
            Err(error) => return Err(garbled(error.to_string())),
        }
    }
    Ok((rows, header.absent()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_fortran_writes_is_named() {
        for (text, named) in [
            ("1.0D+03", ": an exponent is written with E, as 1.0E+03"),
            ("-2.5d-1", ": an exponent is written with E, as 1.0E+03"),
            (
                "*****",
                ": the number did not fit its format, which wants more digits",
            ),
            ("", ""),
            ("abcd", ""),
            ("1.0e+03", ""),
        ] {
            assert_eq!(why_no_number(text), named, "{text}");
        }
    }
}
