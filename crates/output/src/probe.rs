//! The findings of the probe.

use super::number::significant;
use super::table::{Columns, DataTable, Table};
use crate::code::Code;
use crate::study::Verdict;
use crate::study::convention::Finding;

/// Returns the table of the probe, one row per finding.
pub fn probe(findings: &[Finding]) -> DataTable<'_> {
    Columns::<&Finding>::new(
        "probe",
        "A row is one property of the contacts of a code, as micro-tests measure it and as the \
         code declares it.",
        "`tristack probe`, `tristack report` (tables/conventions.csv)",
    )
    .code(|own| &own.code)
    .version(|own| &own.version)
    .text("property", |own| own.property.clone())
    .means("name of the property")
    .number("measured", "1", |own| own.measured)
    .means("what was measured, at vanishing time step if it depends on the step; absent if it could not be")
    .number("uncertainty", "1", |own| own.uncertainty)
    .means("three standard errors, or those of the extrapolation; absent with the measured value")
    .number("declared", "1", |own| own.declared)
    .means(
        "what the code declares; absent where it leaves that out and the measured value is used, and where the property \
         has an effect that vanishes with the time step",
    )
    .verdict(|own| own.verdict)
    .rows(findings)
}

/// Returns a table for people, one row per property and one column per code.
pub fn probe_by_code(findings: &[Finding]) -> Table {
    let mut codes: Vec<Code> = findings
        .iter()
        .map(|finding| finding.code.clone())
        .collect();
    codes.sort();
    codes.dedup();
    let mut properties: Vec<&str> = Vec::new();
    for finding in findings {
        if !properties.contains(&finding.property.as_str()) {
            properties.push(&finding.property);
        }
    }
    let mut columns =
        Columns::for_people().left("property", |property: &&str| property.to_string());
    for code in codes {
        columns = columns.left(code.to_string(), move |property| {
            let mut own = findings.iter();
            let found = own.find(|one| one.code == code && one.property == *property);
            found.map_or_else(|| "-".to_owned(), cell)
        });
        columns = columns.with_verdicts();
    }
    columns.rows(properties).shown()
}

/// Formats the measured value with its uncertainty in brackets, and the declared value unless they agree.
fn cell(finding: &Finding) -> String {
    let (Some(measured), Some(uncertainty)) = (finding.measured, finding.uncertainty) else {
        return format!("unknown{}", of_declared(finding));
    };
    let uncertainty = format!("({uncertainty:.0e})");
    match finding.verdict {
        Verdict::Agrees => format!("{} {uncertainty}", short(measured)),
        Verdict::Differs => format!(
            "{} {uncertainty} differs from {}",
            significant(measured, 8),
            finding.declared.unwrap_or(f64::NAN)
        ),
        _ => format!(
            "{} {uncertainty} inconclusive{}",
            short(measured),
            of_declared(finding)
        ),
    }
}

fn of_declared(finding: &Finding) -> String {
    let declared = finding.declared;
    let word = match finding.key {
        Some(_) => "declared",
        None => "asked for",
    };
    declared.map_or_else(String::new, |declared| format!(", {word} {declared}"))
}

/// Formats `value` to six decimals, without trailing zeros.
fn short(value: f64) -> String {
    let rounded = (value * 1e6).round() / 1e6 + 0.0;
    rounded.to_string()
}
