//! What the probe found, in every format.

use super::number::significant;
use super::table::Table;
use crate::code::Code;
use crate::study::Verdict;
use crate::study::convention::Finding;

/// One line a finding.
pub fn probe_csv(findings: &[Finding]) -> Vec<u8> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    for finding in findings {
        writer
            .serialize(finding)
            .expect("plain rows are written to memory");
    }
    writer.into_inner().expect("memory is flushed")
}

/// As a list of objects.
pub fn probe_json(findings: &[Finding]) -> String {
    serde_json::to_string_pretty(findings).expect("plain rows have a JSON form") + "\n"
}

/// For a terminal: one line a property, one column an code.
pub fn probe_table(findings: &[Finding]) -> String {
    probe_rows(findings).terminal()
}

/// The same for a page.
pub fn probe_markdown(findings: &[Finding]) -> String {
    probe_rows(findings).markdown()
}

/// One row a property, one column an code.
pub fn probe_rows(findings: &[Finding]) -> Table {
    let mut codes: Vec<Code> = findings.iter().map(|finding| finding.code).collect();
    codes.sort();
    codes.dedup();
    let mut columns = vec!["property"];
    columns.extend(codes.iter().map(|code| code.as_str()));
    let mut properties: Vec<&str> = Vec::new();
    for finding in findings {
        if !properties.contains(&finding.property.as_str()) {
            properties.push(&finding.property);
        }
    }
    let mut table = Table::new(&columns);
    for property in properties {
        let mut cells = vec![property.to_owned()];
        for &code in &codes {
            let mut own = findings.iter();
            let found = own.find(|finding| finding.code == code && finding.property == property);
            cells.push(found.map_or_else(|| "-".to_owned(), cell));
        }
        table.push(cells);
    }
    table
}

/// Measured value and, in brackets, its uncertainty; the declaration where they are not the same.
fn cell(finding: &Finding) -> String {
    let (Some(measured), Some(uncertainty)) = (finding.measured, finding.uncertainty) else {
        return format!("unknown, declared {}", finding.declared);
    };
    let uncertainty = format!("({uncertainty:.0e})");
    match finding.verdict {
        Verdict::Agrees => format!("{} {uncertainty}", short(measured)),
        Verdict::Differs => format!(
            "{} {uncertainty} differs from {}",
            significant(measured, 8),
            finding.declared
        ),
        _ => format!(
            "{} {uncertainty} inconclusive, declared {}",
            short(measured),
            finding.declared
        ),
    }
}

/// To six decimals, without trailing zeros.
fn short(value: f64) -> String {
    let rounded = (value * 1e6).round() / 1e6 + 0.0;
    rounded.to_string()
}
