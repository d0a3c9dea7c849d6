//! Metadata of the files as an RO-Crate 1.1 (w3id.org/ro/crate/1.1).

use super::ReportFile;
use super::document::Document;
use super::sections::Origin;
use crate::code::Provenance;
use crate::model::sha256_hex;
use serde_json::{Value, json};

const PAPER: &str = "https://arxiv.org/abs/2511.06807";

/// Returns the content of `ro-crate-metadata.json` for `files`.
pub(super) fn ro_crate(
    document: &Document,
    files: &[ReportFile],
    provenances: &[Provenance],
    origin: &Origin,
) -> String {
    let parts: Vec<Value> = files.iter().map(|file| json!({"@id": file.name})).collect();
    let last = provenances.iter().map(|run| run.date.as_str()).max();
    let programs = programs(provenances);
    let instruments: Vec<Value> = programs
        .iter()
        .map(|own| json!({"@id": own["@id"]}))
        .collect();
    let mut graph = vec![
        json!({
            "@id": "ro-crate-metadata.json",
            "@type": "CreativeWork",
            "conformsTo": {"@id": "https://w3id.org/ro/crate/1.1"},
            "about": {"@id": "./"},
        }),
        json!({
            "@id": "./",
            "@type": "Dataset",
            "name": document.title,
            "description": document.lead.join(" "),
            "datePublished": last,
            "license": {"@id": "https://spdx.org/licenses/MIT"},
            "hasPart": parts,
            "citation": {"@id": PAPER},
            "mentions": {"@id": "#report"},
        }),
        json!({
            "@id": PAPER,
            "@type": "ScholarlyArticle",
            "name": "Anomalous Enhancement of Yield Strength due to Static Friction",
        }),
        json!({
            "@id": "#report",
            "@type": "CreateAction",
            "name": origin.command,
            "endTime": last,
            "instrument": instruments,
            "result": {"@id": "./"},
        }),
    ];
    graph.extend(programs);
    graph.extend(files.iter().map(described));
    let crate_ = json!({"@context": "https://w3id.org/ro/crate/1.1/context", "@graph": graph});
    serde_json::to_string_pretty(&crate_).expect("plain data has a JSON form") + "\n"
}

fn described(file: &ReportFile) -> Value {
    json!({
        "@id": file.name,
        "@type": "File",
        "encodingFormat": media_type(&file.name),
        "contentSize": file.content.len().to_string(),
        "sha256": sha256_hex(&file.content),
    })
}

fn media_type(name: &str) -> &'static str {
    match name.rsplit('.').next() {
        Some("html") => "text/html",
        Some("md") => "text/markdown",
        Some("csv") => "text/csv",
        Some("tex") => "application/x-tex",
        Some("json") => "application/json",
        Some("xml") => "application/xml",
        Some("svg") => "image/svg+xml",
        Some("pdf") => "application/pdf",
        _ => "application/octet-stream",
    }
}

/// Lists tristack and the programs that ran, each once.
fn programs(provenances: &[Provenance]) -> Vec<Value> {
    let program = |name: &str, version: &str| {
        json!({
            "@id": format!("#{name}"),
            "@type": "SoftwareApplication",
            "name": name,
            "softwareVersion": version,
        })
    };
    let mut programs = vec![program("tristack", env!("CARGO_PKG_VERSION"))];
    for run in provenances {
        let identity = &run.identity;
        if !programs.iter().any(|known| known["name"] == identity.code) {
            let version = identity.package.as_ref().unwrap_or(&identity.version);
            programs.push(program(&identity.code, version));
        }
    }
    programs
}
