//! The contact conventions of the codes, as measured.

use super::super::document::{Block, PageTable, Section};
use crate::paper::reproduction::Reproduction;
use crate::study::Verdict;
use crate::study::convention::{Finding, contradictions};
use crate::{probe, probe_by_code};

pub(super) fn section(reproduction: &Reproduction) -> Section {
    let found = findings(reproduction);
    let agreeing = found
        .iter()
        .filter(|finding| finding.verdict == Verdict::Agrees)
        .count();
    let mut blocks = vec![
        Block::paragraph(format!(
            "Codes mean different things by the same words. What each of them means was measured with \
             micro-tests of one contact (`tristack probe`); {agreeing} of {} properties are as the code \
             declares. The arm is $r_1$ in $R = r + r_1 \\times$ overlap; the paper’s is 0.",
            found.len()
        )),
        Block::paragraph(
            "The paper’s tangential spring is a vector that nothing turns while its contact does: its text integrates a \
             velocity, and the program of its authors adds up two components in space. Codes whose spring turns with the contact \
             have another limit above $\\mu_c$, whatever their arms ([](#figure-model-form)). Earlier reports of this program took the \
             paper’s spring for one that turns; `tristack theory --history-update rotated` gives the exact limits that they had.",
        ),
        Block::Table(PageTable::new(
            "conventions",
            "Measured properties, uncertainty in brackets. Arms in units of the overlap; memory, share and pull \
             are 1 for yes, 0 for no. Stiffness, damping and friction are those of the micro-tests, not the paper’s.",
            &probe(&found),
            probe_by_code(&found),
        )),
    ];
    let doubts = reproduction.probes.iter().flat_map(|(code, probed)| {
        let lines = contradictions(probed).into_iter();
        lines.map(move |line| format!("{code}: {line}"))
    });
    let doubts: Vec<String> = doubts.collect();
    if !doubts.is_empty() {
        blocks.push(Block::List { items: doubts });
    }
    Section::new("conventions", "What each code means by a contact", blocks)
}

fn findings(reproduction: &Reproduction) -> Vec<Finding> {
    let probes = reproduction.probes.iter();
    let known = probes.filter_map(|(_, probed)| probed.as_ref().ok());
    known.flat_map(|probed| probed.findings.clone()).collect()
}
