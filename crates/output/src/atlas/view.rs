//! The parts of passports that the pages show.

use crate::code::{Code, ConventionKey};
use crate::number::{one_digit, significant};
use crate::study::Verdict;
use crate::study::atlas::{Atlas, Change, Edge, Meaning, NamedPassport, base_name, meanings};
use crate::study::convention::{KeyRow, PropertyRow, plain};
use crate::table::{Columns, DataTable};
use serde::Serialize;

/// A property in the atlas, and the passport that it is from.
pub(crate) struct Entry<'a> {
    passport: &'a NamedPassport,
    property: &'a PropertyRow,
}

/// Returns every property of every passport.
pub(crate) fn entries(atlas: &Atlas) -> Vec<Entry<'_>> {
    let passports = atlas.passports.iter();
    let entries = passports.flat_map(|passport| {
        let properties = passport.passport.properties.iter();
        properties.map(move |property| Entry { passport, property })
    });
    entries.collect()
}

/// Returns the table of the atlas for programs, one row per property of a passport.
pub(crate) fn atlas_table<'a>(entries: &'a [Entry<'a>]) -> DataTable<'a> {
    Columns::<&Entry>::new(
        "atlas",
        "A row is one property of one version of one style of a code, from its passport.",
        "`tristack atlas` (atlas.json, atlas.csv)",
    )
    .text("passport", |own| own.passport.name.clone())
    .means("permanent name of the passport, passports/NAME.json")
    .text("software", |own| own.passport.passport.software.clone())
    .means("the program")
    .text("version", |own| {
        own.passport.passport.program.version.clone()
    })
    .means("its version")
    .text("style", |own| own.passport.passport.style.clone())
    .means("the contact style")
    .text("property", |own| own.property.property.clone())
    .means("name of the property")
    .number("measured", "1", |own| own.property.measured)
    .means("what was measured; absent if it could not be")
    .number("uncertainty", "1", |own| own.property.uncertainty)
    .means("three standard errors")
    .number("declared", "1", |own| own.property.declared)
    .means("what was declared or asked for")
    .verdict(|own| own.property.verdict)
    .rows(entries)
}

/// A cell of a table on the site.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub(super) struct Cell {
    /// The text that it shows.
    pub text: String,
    /// Its class on the page: `paper`, `other`, `unknown`, `differs` or empty.
    pub class: &'static str,
    /// Link to its evidence.
    pub link: String,
    /// Its tooltip: the same in more words.
    pub title: String,
}

/// A column of the matrix.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub(super) struct Heading {
    pub title: &'static str,
    /// The page of the property, if there is one.
    pub link: Option<String>,
    #[serde(skip)]
    source: Source,
}

/// The source of the cells of a column.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Source {
    Key(ConventionKey),
    /// A property that only nonlinear laws have, and its value for linear springs.
    Law(&'static str, f64),
}

/// Returns the columns of the matrix.
pub(super) fn headings(atlas: &Atlas) -> Vec<Heading> {
    let known = atlas.properties();
    let keys = [
        (
            "pair torque arm",
            ConventionKey::PairTorqueArm,
            "torque_arm",
        ),
        (
            "pair kinematic arm",
            ConventionKey::PairKinematicArm,
            "kinematic_arm",
        ),
        (
            "floor torque arm",
            ConventionKey::FloorTorqueArm,
            "torque_arm",
        ),
        (
            "floor kinematic arm",
            ConventionKey::FloorKinematicArm,
            "kinematic_arm",
        ),
        (
            "Coulomb operand",
            ConventionKey::CoulombOperand,
            "coulomb_damping_share",
        ),
        (
            "spring while sliding",
            ConventionKey::SlidingSpring,
            "sliding_spring_memory",
        ),
        (
            "spring that turns",
            ConventionKey::HistoryUpdate,
            "history_update",
        ),
        ("pull", ConventionKey::TensileForce, "pull"),
        (
            "moment of inertia",
            ConventionKey::MomentOfInertia,
            "moment_of_inertia",
        ),
    ];
    let laws = [
        ("exponent of N", "pair_normal_force_exponent", 1.0),
        ("memory", "pair_history_force_share", 0.0),
        ("rescaling", "pair_history_rescaling", 0.0),
        ("floor over pair stiffness", "floor_ratio", 1.0),
        ("work of a cycle", "pair_cycle_work_sheared_first", 0.0),
    ];
    let keys = keys.map(|(title, key, property)| Heading {
        title,
        link: linked_page(property, &known),
        source: Source::Key(key),
    });
    let laws = laws
        .into_iter()
        .filter(|(_, property, _)| known.contains(property));
    let laws = laws.map(|(title, property, linear)| Heading {
        title,
        link: linked_page(property, &known),
        source: Source::Law(property, linear),
    });
    keys.into_iter().chain(laws).collect()
}

impl Heading {
    /// Returns the cell of `own` in this column.
    pub fn cell(&self, own: &NamedPassport) -> Cell {
        match self.source {
            Source::Key(key) => key_cell(own, key),
            Source::Law(property, linear) => match own.passport.property(property) {
                Some(row) => {
                    let cell = property_cell(own, row);
                    let is_linear = row.measured.is_some_and(|own| (own - linear).abs() <= SAME);
                    match cell.class {
                        "" if is_linear => Cell {
                            class: "paper",
                            ..cell
                        },
                        "" => Cell {
                            class: "other",
                            ..cell
                        },
                        _ => cell,
                    }
                }
                None => Cell {
                    text: "–".to_owned(),
                    class: "",
                    link: format!("{}.html", own.name),
                    title: "linear springs".to_owned(),
                },
            },
        }
    }
}

fn key_cell(own: &NamedPassport, key: ConventionKey) -> Cell {
    let row = own.passport.key(key.as_str());
    let measured = row.and_then(|row| row.measured.clone());
    let class = match (row, &measured) {
        (Some(row), _) if row.verdict == Verdict::Differs => "differs",
        (_, None) => "unknown",
        (Some(row), Some(value)) => match is_the_papers(row, key, value) {
            true => "paper",
            false => "other",
        },
        (None, Some(_)) => "",
    };
    Cell {
        text: measured.map_or_else(
            || "unknown".to_owned(),
            |value| value.parse().map_or(value, short),
        ),
        class,
        link: format!("{}.html#{key}", own.name),
        title: row.map_or_else(String::new, described),
    }
}

/// Whether the value of a key is that of the paper's model, which the native code has.
fn is_the_papers(row: &KeyRow, key: ConventionKey, value: &str) -> bool {
    let paper = Code::native().declaration().unsettled("").value(key);
    match (row.number(), paper.parse::<f64>()) {
        (Some((value, open)), Ok(paper)) => (value - paper).abs() <= open + SAME,
        _ => value == paper,
    }
}

fn described(row: &KeyRow) -> String {
    let declared = row.declared.as_deref().unwrap_or("not declared");
    let open = row
        .uncertainty
        .map_or_else(String::new, |open| format!(" ± {}", one_digit(open)));
    let measured = row.measured.as_deref().unwrap_or("unknown");
    format!(
        "{}: {measured}{open}, declared {declared}: {}",
        row.key, row.verdict
    )
}

/// Returns the cell of `own` for a property.
pub(super) fn property_cell(own: &NamedPassport, row: &PropertyRow) -> Cell {
    let class = match row.verdict {
        Verdict::Differs => "differs",
        _ if row.measured.is_none() => "unknown",
        _ => "",
    };
    Cell {
        text: row.measured.map_or_else(|| "unknown".to_owned(), short),
        class,
        link: format!("{}.html#{}", own.name, row.property),
        title: format!("{}: {}", row.property, measured(row)),
    }
}

/// Formats a number as measured, with its uncertainty, and as declared.
pub(super) fn measured(row: &PropertyRow) -> String {
    let number = match row.measured.zip(row.uncertainty) {
        Some((value, open)) => format!("{} ± {}", significant(value, 9), one_digit(open)),
        None => "unknown".to_owned(),
    };
    match row.declared {
        Some(declared) => format!("{number}, asked for {}", significant(declared, 9)),
        None => number,
    }
}

/// Formats a number to six decimals.
fn short(value: f64) -> String {
    let rounded = (value * 1e6).round() / 1e6 + 0.0;
    rounded.to_string().replace('-', "−")
}

/// Largest difference of two numbers that count as the same.
const SAME: f64 = 1e-6;

/// Returns the page of the property `name`, if that is one of the `known` ones and has a meaning.
pub(super) fn linked_page(name: &str, known: &[&str]) -> Option<String> {
    let base = base_name(name).0;
    let is_known = known.iter().any(|own| base_name(own).0 == base);
    let is_told = is_known && meanings().iter().any(|own| own.name == base);
    is_told.then(|| property_page(base))
}

/// Returns the page of a property.
pub(super) fn property_page(base: &str) -> String {
    format!("property-{}.html", base.replace('_', "-"))
}

/// Returns the page of a program.
pub(super) fn software_page(software: &str) -> String {
    format!("code-{}.html", plain(software))
}

/// A row of the matrix, or of the page of a property.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub(super) struct Row {
    pub name: String,
    pub software: String,
    pub version: String,
    pub style: String,
    /// Whether it is the latest version of its style.
    pub latest: bool,
    /// The page of the program.
    pub page: String,
    pub cells: Vec<Cell>,
    /// The properties that are not as declared or asked for.
    pub differing: Vec<String>,
}

impl Row {
    pub fn new(own: &NamedPassport, latest: bool, cells: Vec<Cell>) -> Self {
        let passport = &own.passport;
        Self {
            name: own.name.clone(),
            software: passport.software.clone(),
            version: passport.program.version.clone(),
            style: passport.style.clone(),
            latest,
            page: software_page(&passport.software),
            cells,
            differing: own.differing().map(str::to_owned).collect(),
        }
    }
}

/// Returns the passports, each with whether it is the latest of its style.
pub(super) fn marked(atlas: &Atlas) -> Vec<(&NamedPassport, bool)> {
    let lineages = atlas.lineages();
    let marked = lineages.flat_map(|versions| {
        let last = versions.len() - 1;
        versions
            .iter()
            .enumerate()
            .map(move |(index, own)| (own, index == last))
    });
    marked.collect()
}

/// A change from one version to the next, as the site shows it.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub(super) struct EdgeView {
    pub id: String,
    pub software: String,
    pub style: String,
    pub page: String,
    pub before: String,
    pub after: String,
    pub before_name: String,
    pub after_name: String,
    pub changes: Vec<ChangeView>,
    pub figures: Vec<DrawnChange>,
}

/// A drawing of what changed.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub(super) struct DrawnChange {
    pub svg: String,
    pub caption: String,
}

#[derive(Debug, Clone, PartialEq, Serialize)]
pub(super) struct ChangeView {
    pub name: String,
    pub page: Option<String>,
    pub before: String,
    pub after: String,
    pub uncertainties: String,
}

impl ChangeView {
    fn new(change: &Change, known: &[&str]) -> Self {
        let text = |value: &Option<String>| match value {
            Some(text) => text.parse().map_or_else(|_| text.clone(), short),
            None => "unknown".to_owned(),
        };
        Self {
            name: change.name.clone(),
            page: linked_page(&change.name, known),
            before: text(&change.before),
            after: text(&change.after),
            uncertainties: change
                .uncertainties()
                .map_or_else(|| "–".to_owned(), one_digit),
        }
    }
}

impl EdgeView {
    pub fn new(edge: &Edge, figures: Vec<DrawnChange>, known: &[&str]) -> Self {
        let (before, after) = (&edge.before.passport, &edge.after.passport);
        let numbers = edge.difference.changes.iter();
        Self {
            id: format!("to-{}", edge.after.name),
            software: after.software.clone(),
            style: after.style.clone(),
            page: software_page(&after.software),
            before: before.program.version.clone(),
            after: after.program.version.clone(),
            before_name: edge.before.name.clone(),
            after_name: edge.after.name.clone(),
            changes: numbers.map(|own| ChangeView::new(own, known)).collect(),
            figures,
        }
    }
}

/// The meaning of a property and the passports that have it.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub(super) struct PropertyView {
    pub meaning: &'static Meaning,
    pub page: String,
    /// The kinds of contact, or the axes, one per column.
    pub kinds: Vec<String>,
    pub rows: Vec<Row>,
    pub figures: Vec<String>,
}

impl PropertyView {
    pub fn new(meaning: &'static Meaning, atlas: &Atlas) -> Self {
        let names = atlas.properties().into_iter();
        let names: Vec<&str> = names
            .filter(|name| base_name(name).0 == meaning.name)
            .collect();
        let rows = marked(atlas).into_iter().filter_map(|(own, latest)| {
            let cells = names.iter().map(|name| match own.passport.property(name) {
                Some(row) => property_cell(own, row),
                None => Cell {
                    text: "–".to_owned(),
                    class: "",
                    link: format!("{}.html", own.name),
                    title: "not measured".to_owned(),
                },
            });
            let cells: Vec<Cell> = cells.collect();
            let any = cells.iter().any(|cell| cell.text != "–");
            any.then(|| Row::new(own, latest, cells))
        });
        Self {
            page: property_page(&meaning.name),
            kinds: names
                .iter()
                .map(|name| match base_name(name).1 {
                    kind if kind.is_empty() => "measured".to_owned(),
                    kind => kind,
                })
                .collect(),
            rows: rows.collect(),
            figures: Vec::new(),
            meaning,
        }
    }
}
