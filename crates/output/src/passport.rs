//! The passport of a code: a JSON object, and a page for people.

use super::number::{digits, one_digit, relative};
use super::probe::probe;
use super::table::{Columns, DataTable};
use super::text::{markdown_code, markdown_text, without_mathematics};
use crate::code::{Code, Identity, TaskKind};
use crate::study::Verdict;
use crate::study::convention::reservations;
use crate::study::convention::{ArmEffects, MeasuredKey, PASSPORT, Passport, TOLERANCE};
use schemars::JsonSchema;
use schemars::generate::SchemaSettings;
use serde::Serialize;
use serde_json::Value;

/// Returns the table of the keys of a convention, as measured.
pub fn measured_convention(keys: &[MeasuredKey]) -> DataTable<'_> {
    Columns::<&MeasuredKey>::new(
        "convention",
        "A row is one key of the convention of a code, as its motions show it.",
        "`tristack probe --out` (`convention` of CODE.json)",
    )
    .text("key", |own| own.key.as_str())
    .means("the key, as in a manifest")
    .shown("key")
    .text("measured", |own| own.measured.clone())
    .means("its value as measured, a number to its uncertainty; absent where the motions do not show it")
    .shown("measured")
    .number("uncertainty", "1", |own| own.uncertainty)
    .means("three standard errors, and what rounding took away; absent for a word")
    .shown_as("±", one_digit)
    .text("declared", |own| own.declared.clone())
    .means("its value in the manifest; absent where that leaves it out and the measured one is used")
    .shown("declared")
    .text("moves_limit", |own| own.key.moves_limit())
    .means("whether it moves the quasi-static limit of the yield force")
    .shown("moves the yield force")
    .verdict(|own| own.verdict)
    .rows(keys)
}

/// Returns the table of what the arms of a code change in the yield force.
pub fn arm_effects(effects: &[ArmEffects]) -> DataTable<'_> {
    Columns::<&ArmEffects>::new(
        "arm_effects",
        "A row is the exact yield force of one stack, and what the measured arms of a code change in it.",
        "`tristack probe --out` (`arm_effects` of CODE.json)",
    )
    .stack(|own| own.stack)
    .number("paper_force", "m g", |own| own.paper_force)
    .means("F with the paper's arms, which are all 0")
    .shown_as("paper's arms", digits::<7>)
    .number("pair_torque_arm", "m g", |own| own.changes[0])
    .means("change of F by the torque arm of pairs alone")
    .shown_as("pair torque", relative)
    .number("pair_kinematic_arm", "m g", |own| own.changes[1])
    .means("the same by the kinematic arm of pairs")
    .shown_as("pair kinematic", relative)
    .number("floor_torque_arm", "m g", |own| own.changes[2])
    .means("the same by the torque arm of the floor")
    .shown_as("floor torque", relative)
    .number("floor_kinematic_arm", "m g", |own| own.changes[3])
    .means("the same by the kinematic arm of the floor")
    .shown_as("floor kinematic", relative)
    .number("force", "m g", |own| own.force)
    .means("F with all arms of the code")
    .shown_as("all its arms", digits::<9>)
    .number("uncertainty", "m g", |own| own.uncertainty)
    .means("what the uncertainty of the arms leaves open of it")
    .shown_as("±", one_digit)
    .rows(effects)
}

/// Formats the passport as JSON; `command` is the command that made it.
pub fn passport_json(passport: &Passport, command: &str) -> String {
    let provenance = &passport.findings.provenance;
    let convention = measured_convention(&passport.convention);
    let effects = arm_effects(&passport.effects);
    let properties = probe(&passport.findings.findings);
    let document = Document {
        schema: PASSPORT,
        command,
        code: passport.code.clone(),
        title: passport.code.title(),
        software: passport.code.software(),
        style: passport.code.style(),
        install: passport.code.installation_hint(),
        verdict: passport.verdict(),
        twins: &passport.twins,
        same_arms: &passport.same_arms,
        program: &provenance.identity,
        deck_hash: passport.code.files_hash(TaskKind::Motion),
        answers_hash: &provenance.deck_hash,
        tristack: &provenance.tristack,
        date: &provenance.date,
        machine: &provenance.machine,
        reservations: reservations(passport.findings),
        time_step_effects: passport.time_step_effects(),
        digits: passport.findings.digits,
        single_precision: &passport.findings.single,
        convention: convention.part(),
        arm_effects: effects.part(),
        properties: properties.part(),
    };
    serde_json::to_string_pretty(&document).expect("plain values have a JSON form") + "\n"
}

/// Returns the JSON Schema of a passport.
pub(super) fn passport_schema() -> Value {
    let settings = SchemaSettings::draft2020_12().for_serialize();
    let generator = settings.into_generator();
    let mut schema = generator.into_root_schema_for::<Document<()>>().to_value();
    let properties = &mut schema["properties"];
    properties["convention"] = measured_convention(&[]).json_schema();
    properties["arm_effects"] = arm_effects(&[]).json_schema();
    properties["properties"] = probe(&[]).json_schema();
    schema
}

/// Passport of a code: its contact convention as micro-tests measure it.
#[derive(Serialize, JsonSchema)]
#[schemars(title = "Passport")]
struct Document<'a, T> {
    /// Name and version of the format.
    schema: &'static str,
    /// The command that made it.
    command: &'a str,
    /// Name of the code.
    #[schemars(with = "String")]
    code: Code,
    /// Its name in prose.
    title: &'a str,
    /// The program, which its versions and styles share.
    software: &'a str,
    /// The contact style, the same in all versions of the program.
    style: &'a str,
    /// How to install the program.
    install: String,
    /// The worst verdict on a property.
    verdict: Verdict,
    /// Codes that mean the same by a contact.
    #[schemars(with = "Vec<String>")]
    twins: &'a [Code],
    /// Codes with the same arms.
    #[schemars(with = "Vec<String>")]
    same_arms: &'a [Code],
    /// The program that was probed.
    program: &'a Identity,
    /// SHA-256 of the files of the micro-tests.
    deck_hash: String,
    /// SHA-256 of everything that the micro-tests were given.
    answers_hash: &'a str,
    /// Version of tristack.
    tristack: &'a str,
    /// Date of the probe, UTC.
    date: &'a str,
    /// Processor and system.
    machine: &'a str,
    /// What it leaves open.
    reservations: Vec<String>,
    /// What its contacts do otherwise in long steps than in short ones; arms are those of short steps.
    time_step_effects: Vec<String>,
    /// Number of significant digits of the motions, where they are fewer than a number has.
    #[serde(skip_serializing_if = "Option::is_none")]
    digits: Option<u32>,
    /// Quantities of the motions that are numbers of 32 bits, where there are any.
    #[serde(skip_serializing_if = "<[_]>::is_empty")]
    single_precision: &'a [&'static str],
    convention: T,
    arm_effects: T,
    properties: T,
}

/// Formats the passport as a page.
pub fn passport_markdown(passport: &Passport, command: &str) -> String {
    let Passport { code, findings, .. } = passport;
    let provenance = &findings.provenance;
    let mut page = format!(
        "# Passport of {}\n\n{}\n\nProbed by tristack {} on {} with {}.\n\n**{}**\n\n",
        markdown_text(&without_mathematics(&code.label())),
        program(&provenance.identity),
        provenance.tristack,
        &provenance.date.get(..10).unwrap_or(&provenance.date),
        markdown_code(command),
        sentence(passport),
    );
    for line in reservations(findings) {
        page += &format!("- {}\n", markdown_text(&line));
    }
    if !page.ends_with("\n\n") {
        page += "\n";
    }
    page += &format!(
        "## What a contact is to it\n\nr₁ in R = r + r₁ × overlap is an arm. {}\n\n{}",
        twins(passport),
        measured_convention(&passport.convention).shown().markdown()
    );
    let points = findings.measured.contact_points();
    if !points.is_empty() {
        page += &format!("\nIn words: {}.\n", points.join("; "));
    }
    for effect in passport.time_step_effects() {
        page += &format!(
            "\nIts steps: {}. Arms are those of short steps.\n",
            markdown_text(&effect)
        );
    }
    page += &format!(
        "\n## What its arms change\n\nThe exact yield force F = f/(m g) with the paper's arms, its change by each arm of the code alone, and F with \
         all of them.\n\n{}",
        arm_effects(&passport.effects).shown().markdown()
    );
    page + &parameters(passport)
}

/// Describes the program in one paragraph.
fn program(identity: &Identity) -> String {
    let hash = |hash: &Option<String>| {
        let hash = hash.as_deref().unwrap_or("none");
        format!("`{}`", hash.get(..16).unwrap_or(hash))
    };
    let package = identity.package.as_deref().unwrap_or("no package");
    format!(
        "{} {}, {}; SHA-256 of the program {}, of the files that it loads {}.",
        markdown_code(&identity.code),
        markdown_text(&without_mathematics(&identity.version)),
        markdown_text(&without_mathematics(package)),
        hash(&identity.program_hash),
        hash(&identity.files_hash)
    )
}

/// States the verdict in words.
fn sentence(passport: &Passport) -> String {
    let keys = passport.convention.iter();
    let unknown: Vec<_> = keys.filter(|own| own.measured.is_none()).collect();
    match passport.verdict() {
        Verdict::Agrees => "Every property is as declared, or measured where nothing is declared.",
        Verdict::Differs => {
            "It is not the code that its manifest declares: no yield force is judged."
        }
        _ if !passport.findings.measured.knows_limit() => {
            "The yield force depends on an arm that is not known, or on whether the spring of a pair turns with it, which is not: no \
             yield force is judged."
        }
        _ if !unknown.is_empty() => {
            "Nothing contradicts its manifest. It has a rule that is none of those that tristack knows, or that its motions do \
             not show; the yield force does not depend on it."
        }
        _ => "Nothing contradicts its manifest, but not everything could be measured well enough.",
    }
    .to_owned()
}

fn twins(passport: &Passport) -> String {
    let names = |codes: &[Code]| {
        let names = codes.iter().map(|code| format!("`{code}`"));
        names.collect::<Vec<_>>().join(", ")
    };
    match (&passport.twins[..], &passport.same_arms[..]) {
        ([], []) => "No built-in code has the same arms.".to_owned(),
        ([], same) => format!(
            "It has the arms, and with them the yield forces, of {}; other rules differ.",
            names(same)
        ),
        (twins, same) => {
            let others: Vec<Code> = same
                .iter()
                .filter(|own| !twins.contains(own))
                .cloned()
                .collect();
            let further = match others.is_empty() {
                true => String::new(),
                false => format!(" The same arms alone: {}.", names(&others)),
            };
            format!("It has the convention of {}.{further}", names(twins))
        }
    }
}

/// States how many of the properties outside the convention are as asked for.
fn parameters(passport: &Passport) -> String {
    let findings = passport.findings.findings.iter();
    let others: Vec<_> = findings.filter(|own| own.key.is_none()).collect();
    let agreeing = others.iter().filter(|own| own.verdict == Verdict::Agrees);
    let tolerance = match passport.code.is_native() {
        true => "rounding".to_owned(),
        false => format!("{TOLERANCE:e}"),
    };
    format!(
        "\n## What it was asked for\n\n{} of {} properties (mass, stiffness, damping, friction, radius, times of forces, the top \
         wall) are what the case says, to {tolerance}. All numbers: `{}.json`.\n",
        agreeing.count(),
        others.len(),
        passport.code
    )
}
