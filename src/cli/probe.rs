//! `tristack probe`.

use super::findings::exchange_all;
use super::options::{CodeOptions, Format, RunOptions, check_springs, selected_codes};
use super::out::{Out, write};
use super::progress::Reporter;
use super::{CliError, ExitStatus, INTERRUPT, complain, tell};
use crate::code::Settled;
use crate::files::{FileError, Layout};
use crate::model::shown;
use crate::output::{json, passport_json, passport_markdown, probe, probe_by_code};
use crate::runs::{Finder, SelectedCode};
use crate::study::Verdict;
use crate::study::atlas::NamedPassport;
use crate::study::convention::{
    Finding, NO_CONTACT, Passport, Probed, contradiction, in_single_precision, passport, probe_all,
    step_effects,
};
use clap::Args;
use std::path::{Path, PathBuf};

/// Measure the contact convention of each code, and compare it with the declared one
///
/// Runs micro-tests of a single contact (cylinder on cylinder, on the floor, on the top wall) and determines
/// stiffness, damping, torque arm, kinematic arm, friction, Coulomb operand and the treatment of the
/// tangential spring from the reported motion and forces. Recorded answers stand in for codes that are not
/// installed.
#[derive(Debug, Args)]
#[command(after_help = "Example: tristack probe --codes native,lammps --format json")]
pub(super) struct Arguments {
    #[command(flatten)]
    codes: CodeOptions,
    #[command(flatten)]
    run: RunOptions,
    /// Directory for the passport of each code, CODE.json and the page CODE.md, and all_codes.json and all_codes.csv with
    /// the findings
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Directory in which the passport of each code is filed under its permanent name, of program, version, style and
    /// digest; nothing in it is replaced
    #[arg(long, value_name = "DIR")]
    passports: Option<PathBuf>,
    /// Format of the findings
    #[arg(long, value_enum, default_value_t = Format::Table)]
    format: Format,
}

/// Probes the codes and prints the findings.
pub(super) fn run(arguments: &Arguments, command: &str) -> Result<ExitStatus, CliError> {
    let named = arguments.codes.named();
    check_springs(&named)?;
    let codes = selected_codes(&named)?;
    let out = Out::claim(arguments.out.as_deref(), &layout())?;
    if let Some(directory) = &arguments.passports {
        std::fs::create_dir_all(directory).map_err(FileError::writing(directory))?;
    }
    let settings = arguments.run.settings()?;
    let probed = probe_all(&codes, &settings, &Reporter::new());
    let findings: Vec<Finding> = probed
        .iter()
        .flatten()
        .flat_map(|probe| probe.findings.clone())
        .collect();
    let people = || for_people(&probed);
    let tables = [probe(&findings)];
    let printed = arguments.format.print(&tables, command, people);
    let known = codes.iter().zip(&probed);
    let known = known.filter_map(|(own, probed)| Some((own.name.clone(), probed.as_ref().ok()?)));
    let passports: Vec<Passport> = known.map(|(code, own)| passport(&code, own)).collect();
    let filed = match &arguments.passports {
        Some(directory) if is_whole(&probed) => file(directory, &passports, command),
        _ => ExitStatus::Success,
    };
    let written = out.write_whole(is_whole(&probed), || {
        let mut files = vec![
            ("all_codes.csv".to_owned(), tables[0].csv()),
            (ALL_CODES.to_owned(), json(&tables, command)),
        ];
        for own in &passports {
            let code = own.code.clone();
            files.push((format!("{code}.json"), passport_json(own, command)));
            files.push((format!("{code}.md"), passport_markdown(own, command)));
        }
        files
    });
    let concluded = conclude(&codes, &probed, &findings);
    exchange_all(Finder::Probe, &codes, &settings.store, |selected| {
        let own = findings.iter().filter(|own| own.code == selected.name);
        own.filter(|own| own.verdict == Verdict::Differs)
            .map(contradiction)
            .collect()
    });
    Ok(concluded.max(printed).max(written).max(filed))
}

/// Returns the findings as people read them. A code in which no contact acts has no column, since all of it would say
/// `unknown`.
fn for_people(probed: &[Probed]) -> String {
    let answered = probed.iter().flatten();
    let (silent, others): (Vec<_>, Vec<_>) = answered.partition(|probe| probe.no_contact);
    let findings = others.iter().flat_map(|probe| probe.findings.clone());
    let findings: Vec<Finding> = findings.collect();
    match findings.is_empty() && !silent.is_empty() {
        true => String::new(),
        false => probe_by_code(&findings).terminal(),
    }
}

/// Files `passports` in `directory` under their permanent names.
fn file(directory: &Path, passports: &[Passport], command: &str) -> ExitStatus {
    let mut worst = ExitStatus::Success;
    for own in passports {
        let text = passport_json(own, command).into_bytes();
        let named = match NamedPassport::read(text) {
            Ok(named) => named,
            Err(error) => {
                complain!("error: the passport of {} is not filed: {error}", own.code);
                worst = worst.max(ExitStatus::NotWritten);
                continue;
            }
        };
        let path = directory.join(format!("{}.json", named.name));
        worst = worst.max(write(&path, &named.text));
        tell!("{}", shown(&path));
    }
    worst
}

/// The file that marks a directory with passports; no code has an underscore in its name.
const ALL_CODES: &str = "all_codes.json";

/// Returns the files that are written.
fn layout() -> Layout {
    Layout::tables(ALL_CODES, &["all_codes.csv", "*.json", "*.md"])
}

/// Returns whether no interrupt has left a code out.
fn is_whole(probed: &[Probed]) -> bool {
    !INTERRUPT.requested() || probed.iter().all(Result::is_ok)
}

/// Summarizes the findings on standard error, and returns the exit status.
fn conclude(codes: &[SelectedCode], probed: &[Probed], findings: &[Finding]) -> ExitStatus {
    for (selected, result) in codes.iter().zip(probed) {
        if let Err(error) = result
            && !INTERRUPT.requested()
        {
            complain!("{} was not probed: {error}", selected.name);
        } else if selected.code.is_none() {
            let name = selected.name.clone();
            tell!("{name} is not installed: its recorded answers stand in for it");
        }
    }
    for (selected, result) in codes.iter().zip(probed) {
        if let Ok(probe) = result
            && let Some(digits) = probe.few_digits()
        {
            let name = selected.name.clone();
            tell!("{name}: its motions are printed with {digits} digits, too few to contradict it");
        }
    }
    for (selected, result) in codes.iter().zip(probed) {
        if result.as_ref().is_ok_and(|probe| probe.no_contact) {
            tell!("{}: {NO_CONTACT}", selected.name);
            continue;
        }
        if let Some(told) = result.as_ref().ok().and_then(in_single_precision) {
            tell!("{}: {told}", selected.name);
        }
        let measured = result.iter().map(|probe| &probe.measured);
        for told in measured.flat_map(Settled::contact_points) {
            tell!("{}: {told}", selected.name);
        }
        let findings = result.iter().flat_map(|probe| &probe.findings);
        if let Some(effects) = step_effects(findings) {
            tell!("{}: {effects}", selected.name);
        }
    }
    for finding in findings {
        let of_surface = finding.time_step_effect();
        for remark in finding
            .other_model()
            .into_iter()
            .chain(finding.growth())
            .chain(of_surface.filter(|_| finding.step_effect.is_none()))
            .chain(finding.energy_made())
        {
            tell!("{}: {remark}", finding.code);
        }
    }
    let count = |verdict| findings.iter().filter(|own| own.verdict == verdict).count();
    let (agreeing, differing) = (count(Verdict::Agrees), count(Verdict::Differs));
    tell!(
        "{agreeing} of {} properties are as declared{}, {differing} differ, {} are inconclusive",
        findings.len(),
        match findings.iter().any(|own| own.declared.is_none()) {
            true => " or measured where nothing is declared",
            false => "",
        },
        findings.len() - agreeing - differing
    );
    if !is_whole(probed) {
        ExitStatus::Interrupted
    } else if differing > 0 {
        ExitStatus::Disagreement
    } else if probed.iter().any(Result::is_err) {
        ExitStatus::CodeFailed
    } else if agreeing < findings.len() {
        ExitStatus::Inconclusive
    } else {
        ExitStatus::Success
    }
}
