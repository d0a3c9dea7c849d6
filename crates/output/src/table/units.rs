//! The units of the columns that people see.

use super::DataTable;

impl DataTable<'_> {
    /// Returns a line for below the table that names the unit of every column that has one; empty if none has.
    pub(crate) fn units(&self) -> String {
        let mut units: Vec<(&str, Vec<&str>)> = Vec::new();
        let measured = self.headed();
        let measured = measured.filter(|(_, column)| !["", "1"].contains(&column.unit));
        for (heading, column) in measured {
            match units.iter_mut().find(|(unit, _)| *unit == column.unit) {
                Some((_, headings)) => headings.push(heading),
                None => units.push((column.unit, vec![heading])),
            }
        }
        let each = units.iter();
        let each = each.map(|(unit, headings)| format!("{} in {unit}", headings.join(", ")));
        match each.collect::<Vec<_>>().join("; ") {
            nothing if nothing.is_empty() => nothing,
            line => line + "\n",
        }
    }
}
