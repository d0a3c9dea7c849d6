//! The files of the site.

use super::view::{
    DrawnChange, EdgeView, PropertyView, Row, atlas_table, entries, headings, linked_page, marked,
    measured, property_page, software_page,
};
use crate::code::ConventionKey;
use crate::figures::{arm_svg, spread_svg, stiffness_svg, values_svg};
use crate::model::sha256_hex;
use crate::number::{digits, one_digit, relative, significant};
use crate::study::Verdict;
use crate::study::atlas::{
    Atlas, Edge, NamedPassport, SPREAD_STIFFNESS, StiffnessLaw, Verdicts, base_name, meanings,
};
use crate::table::json;
use minijinja::value::Serde;
use minijinja::{AutoEscape, Environment, UndefinedBehavior, Value as Shown};
use rayon::iter::{IntoParallelRefIterator, ParallelIterator};
use serde_json::{Value, json as page};
use std::collections::BTreeMap;

/// The templates: the frame of every page, and what stands inside.
const TEMPLATES: [(&str, &str); 7] = [
    ("base.html", include_str!("base.html")),
    ("index.html", include_str!("index.html")),
    ("code.html", include_str!("code.html")),
    ("property.html", include_str!("property.html")),
    ("passport.html", include_str!("passport.html")),
    ("changes.html", include_str!("changes.html")),
    ("problems.html", include_str!("problems.html")),
];

/// The script of the overview, which filters its rows. No other script runs on any page.
const FILTER: &str = include_str!("filter.js");

/// The page of the problems.
const PROBLEMS: &str = "problems.html";

/// Maximum number of figures of one change.
const MOST_FIGURES: usize = 4;

/// A file of the site: path and content.
type SiteFile = (String, Vec<u8>);

/// A problem with an exact answer: its name, its verdicts as JSON, and the same verdicts, parsed.
pub type Problem = (String, Vec<u8>, Verdicts);

/// Returns all files of the site. `command` is the command that makes it. The bytes are the same for the same
/// passports and verdicts.
pub fn atlas_files(atlas: &Atlas, problems: &[Problem], command: &str) -> Vec<SiteFile> {
    let site = Site::new(atlas, problems, command);
    let rows = entries(atlas);
    let table = [atlas_table(&rows)];
    let mut files: Vec<SiteFile> = vec![
        ("atlas.json".to_owned(), json(&table, command).into_bytes()),
        ("atlas.csv".to_owned(), table[0].csv().into_bytes()),
        ("index.html".to_owned(), site.index()),
    ];
    files.extend(site.codes());
    files.extend(site.properties());
    if !problems.is_empty() {
        files.push((PROBLEMS.to_owned(), site.problems()));
    }
    for (name, text, _) in problems {
        files.push((format!("verdicts/{name}.json"), text.clone()));
    }
    for own in atlas.passports.iter().chain(&atlas.replaced) {
        files.push((format!("{}.html", own.name), site.passport(own)));
        files.push((format!("passports/{}.json", own.name), own.text.clone()));
        files.push((format!("badges/{}.svg", own.name), badge(own).into_bytes()));
    }
    files
}

/// The data and templates of all pages.
struct Site<'a> {
    atlas: &'a Atlas,
    problems: &'a [Problem],
    command: &'a str,
    environment: Environment<'static>,
    edges: Vec<EdgeView>,
}

impl<'a> Site<'a> {
    fn new(atlas: &'a Atlas, problems: &'a [Problem], command: &'a str) -> Self {
        let mut environment = Environment::new();
        environment.set_undefined_behavior(UndefinedBehavior::Strict);
        environment.set_auto_escape_callback(|_| AutoEscape::Html);
        for (name, text) in TEMPLATES {
            environment
                .add_template(name, text)
                .expect("the templates are part of the program and tested");
        }
        let edges = atlas.edges();
        let known = atlas.properties();
        let edges = edges
            .par_iter()
            .map(|edge| EdgeView::new(edge, drawings(atlas, edge), &known));
        Self {
            atlas,
            problems,
            command,
            environment,
            edges: edges.collect(),
        }
    }

    fn render(&self, template: &str, mut page: Value) -> Vec<u8> {
        let template = self.environment.get_template(template);
        let template = template.expect("the template was added");
        page["command"] = self.command.into();
        page["filter_source"] = script_source(FILTER).into();
        let text = template.render(Shown::from(Serde(page)));
        text.expect("the template uses only what it is given")
            .into_bytes()
    }

    fn index(&self) -> Vec<u8> {
        let headings = headings(self.atlas);
        let matrix = marked(self.atlas).into_iter().map(|(own, latest)| {
            let cells = headings.iter().map(|heading| heading.cell(own));
            Row::new(own, latest, cells.collect())
        });
        let matrix: Vec<Row> = matrix.collect();
        let spread = self.atlas.spread();
        let groups = spread.iter().map(|own| {
            let arms = own.arms.map(|arm| arm.to_string().replace('-', "−"));
            page!({ "arms": arms.join(", "), "codes": own.codes })
        });
        let mut software: Vec<&str> = matrix.iter().map(|row| row.software.as_str()).collect();
        software.dedup();
        let software = software
            .iter()
            .map(|name| (software_page(name), name.to_string()));
        let properties = self.meanings_by_group();
        self.render(
            "index.html",
            page!({
                "title": "Atlas of contacts",
                "filter": FILTER,
                "headings": headings,
                "differing": matrix.iter().filter(|row| !row.differing.is_empty()).collect::<Vec<_>>(),
                "groups": groups.collect::<Vec<_>>(),
                "spread": spread_svg(&spread),
                "stiffness": SPREAD_STIFFNESS.to_string(),
                "edges": self.edges,
                "software": software.collect::<Vec<_>>(),
                "properties": properties,
                "matrix": matrix,
                "problems": (!self.problems.is_empty()).then_some(PROBLEMS),
            }),
        )
    }

    /// Returns page and title of every property that some passport has, by its group.
    fn meanings_by_group(&self) -> Vec<(&str, Vec<(String, &str)>)> {
        let known = self.atlas.properties();
        let mut groups: Vec<(&str, Vec<(String, &str)>)> = Vec::new();
        for own in meanings() {
            if !known.iter().any(|name| base_name(name).0 == own.name) {
                continue;
            }
            let entry = (property_page(&own.name), own.title.as_str());
            match groups.iter_mut().find(|(group, _)| *group == own.group) {
                Some((_, entries)) => entries.push(entry),
                None => groups.push((&own.group, vec![entry])),
            }
        }
        groups
    }

    fn problems(&self) -> Vec<u8> {
        let problems = self.problems.iter().map(|(name, _, verdicts)| {
            let error = |error: Option<f64>| error.map_or_else(|| "–".to_owned(), relative);
            let force = |force: Option<f64>| force.map_or_else(|| "–".to_owned(), digits::<9>);
            let codes = verdicts.by_code().into_iter().map(|own| {
                page!({
                    "code": own.code,
                    "version": own.version,
                    "agreeing": own.agreeing,
                    "without_yield": own.without_yield,
                    "rows": own.rows,
                    "error": error(own.largest_error),
                })
            });
            let rows = verdicts.rows.iter().map(|row| {
                page!({
                    "code": row.code,
                    "stiffness": row.stiffness.to_string(),
                    "mu": significant(row.mu, 7),
                    "force": force(row.yield_force),
                    "exact": force(row.reference_force),
                    "error": error(row.error),
                    "verdict": row.verdict.as_str(),
                })
            });
            page!({
                "name": name,
                "title": name.replace('-', " "),
                "command": verdicts.command,
                "codes": codes.collect::<Vec<_>>(),
                "rows": rows.collect::<Vec<_>>(),
            })
        });
        let problems: Vec<Value> = problems.collect();
        self.render(
            "problems.html",
            page!({ "title": "Exact problems", "problems": problems }),
        )
    }

    fn codes(&self) -> Vec<SiteFile> {
        let headings = headings(self.atlas);
        let mut pages: BTreeMap<String, (&str, Vec<Value>)> = BTreeMap::new();
        for versions in self.atlas.lineages() {
            let own = &versions[0].passport;
            let last = versions.len() - 1;
            let rows = versions.iter().enumerate().map(|(index, version)| {
                let cells = headings.iter().map(|heading| heading.cell(version));
                Row::new(version, index == last, cells.collect())
            });
            let edges = self.edges.iter();
            let edges = edges.filter(|edge| versions.iter().any(|own| own.name == edge.after_name));
            let style = page!({
                "style": own.style,
                "rows": rows.collect::<Vec<_>>(),
                "edges": edges.collect::<Vec<_>>(),
            });
            // Programs whose names differ only in case or punctuation share a page.
            let page = pages.entry(software_page(&own.software));
            page.or_insert((&own.software, Vec::new())).1.push(style);
        }
        let files = pages.into_iter().map(|(name, (software, styles))| {
            let page = page!({ "title": software, "headings": headings, "styles": styles });
            (name, self.render("code.html", page))
        });
        files.collect()
    }

    fn properties(&self) -> Vec<SiteFile> {
        let views = meanings().iter().map(|meaning| {
            let mut view = PropertyView::new(meaning, self.atlas);
            view.figures = self.property_figures(&view);
            view
        });
        let files = views.filter(|view| !view.rows.is_empty()).map(|view| {
            let page = page!({ "title": view.meaning.title, "property": view });
            (view.page.clone(), self.render("property.html", page))
        });
        files.collect()
    }

    /// Draws what an arm does to the yield force, if the property is one, and the values of the latest versions.
    fn property_figures(&self, view: &PropertyView) -> Vec<String> {
        let name = &view.meaning.name;
        let arms = ConventionKey::ARMS.into_iter();
        let arms = arms.filter(|key| key.as_str().ends_with(name.as_str()));
        let mut figures: Vec<String> = arms
            .map(|key| arm_svg(key.as_str(), &self.atlas.arm_curves(key)))
            .collect();
        let latest = marked(self.atlas).into_iter().filter(|(_, latest)| *latest);
        let rows = latest.filter_map(|(own, _)| {
            let passport = &own.passport;
            let properties = passport.properties.iter();
            let own = properties.filter(|row| base_name(&row.property).0 == name);
            let values: Vec<f64> = own.filter_map(|row| row.measured).collect();
            let words = format!("{}: {}", passport.software, passport.style);
            (!values.is_empty()).then_some((words, values))
        });
        figures.push(values_svg(&rows.collect::<Vec<_>>()));
        figures
    }

    fn passport(&self, own: &NamedPassport) -> Vec<u8> {
        let passport = &own.passport;
        let known = self.atlas.properties();
        let convention = passport.convention.iter().map(|row| {
            let open = row.uncertainty.map_or_else(|| "–".to_owned(), one_digit);
            page!({
                "key": row.key,
                "measured": row.measured.as_deref().unwrap_or("unknown"),
                "open": open,
                "declared": row.declared.as_deref().unwrap_or("–"),
                "moves_limit": row.moves_limit,
                "verdict": row.verdict.as_str(),
            })
        });
        let forces = passport.arm_effects.iter().map(|row| {
            let shown =
                |force: Option<f64>| force.map_or_else(|| "unknown".to_owned(), digits::<9>);
            page!({
                "stiffness": row.stiffness.to_string(),
                "mu": row.mu.to_string(),
                "paper": shown(row.paper_force),
                "own": shown(row.force),
                "open": row.uncertainty.map_or_else(|| "–".to_owned(), one_digit),
            })
        });
        let properties = passport.properties.iter().map(|row| {
            page!({
                "name": row.property,
                "page": linked_page(&row.property, &known),
                "measured": measured(row),
                "verdict": row.verdict.as_str(),
            })
        });
        let page = page!({
            "title": format!("{} {}, {}", passport.software, passport.program.version, passport.style),
            "name": own.name,
            "software": passport.software,
            "page": software_page(&passport.software),
            "code": passport.code,
            "version": passport.program.version,
            "style": passport.style,
            "package": passport.program.package,
            "program_hash": passport.program.program_hash,
            "install": passport.install,
            "made_by": passport.command,
            "tristack": passport.tristack,
            "date": passport.date.get(..10).unwrap_or(&passport.date),
            "machine": passport.machine,
            "reservations": passport.reservations,
            "effects": passport.time_step_effects,
            "convention": convention.collect::<Vec<_>>(),
            "forces": forces.collect::<Vec<_>>(),
            "properties": properties.collect::<Vec<_>>(),
            "badge": badge(own),
            "sentence": sentence(own),
        });
        self.render("passport.html", page)
    }
}

/// Returns the source by which a content security policy accepts this `script`: its SHA-256 in base 64.
fn script_source(script: &str) -> String {
    const DIGITS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let hex = sha256_hex(script.as_bytes());
    let bits: String = hex
        .chars()
        .filter_map(|digit| digit.to_digit(16))
        .map(|digit| format!("{digit:04b}"))
        .collect();
    let sixes = bits.as_bytes().chunks(6).map(|six| {
        let value = (0..6).fold(0, |value, at| {
            2 * value + usize::from(six.get(at) == Some(&b'1'))
        });
        char::from(DIGITS[value])
    });
    // 32 bytes are 43 digits, and one sign fills up the last group of four.
    format!("sha256-{}=", sixes.collect::<String>())
}

/// Returns how many properties are as declared or asked for, and how many there are.
fn counted(own: &NamedPassport) -> (usize, usize) {
    let properties = own.passport.properties.iter();
    let agreeing = properties.filter(|row| row.verdict == Verdict::Agrees);
    (agreeing.count(), own.passport.properties.len())
}

/// Sums up the passport in one sentence, which its authors may cite.
fn sentence(own: &NamedPassport) -> String {
    let passport = &own.passport;
    let (agreeing, all) = counted(own);
    format!(
        "{} {} ({}): {agreeing} of {all} contact properties as declared, measured by the micro-tests of tristack {} on {}; passport {}.",
        passport.software,
        passport.program.version,
        passport.style,
        passport.tristack,
        passport.date.get(..10).unwrap_or(&passport.date),
        own.name
    )
}

/// Draws what changed: a stiffness over the overlap, any other known number over all versions of the style.
fn drawings(atlas: &Atlas, edge: &Edge) -> Vec<DrawnChange> {
    let mut drawn: Vec<(String, DrawnChange)> = Vec::new();
    for change in &edge.difference.changes {
        // A stiffness and its exponent are one curve.
        let stiffness = change.name.strip_suffix("_exponent");
        let stiffness = stiffness.filter(|name| name.ends_with("stiffness"));
        let name = stiffness.unwrap_or(&change.name);
        if drawn.len() == MOST_FIGURES || drawn.iter().any(|(own, _)| own == name) {
            continue;
        }
        let words = name.replace('_', " ");
        let figure = match stiffness_laws(edge, name) {
            Some([before, after]) => Some(DrawnChange {
                svg: stiffness_svg(&words, &before, &after),
                caption: format!("{words} over the overlap, by the numbers of both passports"),
            }),
            None => change.change.map(|_| DrawnChange {
                svg: values_svg(&versions(atlas, edge, name)),
                caption: format!("{words}, by version"),
            }),
        };
        drawn.extend(figure.map(|figure| (name.to_owned(), figure)));
    }
    drawn.into_iter().map(|(_, figure)| figure).collect()
}

/// Returns the laws of the stiffness `name` in both versions, or `None` if `name` is no stiffness.
fn stiffness_laws(edge: &Edge, name: &str) -> Option<[StiffnessLaw; 2]> {
    let law = |own: &NamedPassport| StiffnessLaw::of(&own.passport, name);
    name.ends_with("stiffness")
        .then(|| Some([law(edge.before)?, law(edge.after)?]))?
}

/// Returns the values of `property` in all versions of the style.
fn versions(atlas: &Atlas, edge: &Edge, property: &str) -> Vec<(String, Vec<f64>)> {
    let mut lineages = atlas.lineages();
    let own = lineages.find(|versions| versions.contains(edge.after));
    let versions = own.into_iter().flatten().map(|own| {
        let row = own.passport.property(property);
        let value = row.and_then(|row| row.measured);
        (
            own.passport.program.version.clone(),
            value.into_iter().collect(),
        )
    });
    versions.collect()
}

/// Draws a badge for the page of a code: how many of its properties are as declared.
fn badge(own: &NamedPassport) -> String {
    let (agreeing, all) = counted(own);
    let (left, right) = (
        "contact passport",
        format!("{agreeing} of {all} as declared"),
    );
    let colour = match own.differing().next() {
        Some(_) => "#a33b00",
        None => "#00694d",
    };
    // Letters of 11 px are 6.4 px wide on average.
    let width = |text: &str| 6.4 * text.chars().count() as f64 + 12.0;
    let (first, second) = (width(left), width(&right));
    let whole = first + second;
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{whole:.0}\" height=\"20\" role=\"img\" aria-label=\"{left}: {right}\">\n\
         <title>{left}: {right}</title>\n\
         <rect width=\"{whole:.0}\" height=\"20\" rx=\"3\" fill=\"#3a3a3a\"/>\n\
         <path d=\"M{first:.0} 0h{:.0}a3 3 0 0 1 3 3v14a3 3 0 0 1-3 3h-{:.0}z\" fill=\"{colour}\"/>\n\
         <g fill=\"#fff\" font-family=\"DejaVu Sans, Verdana, sans-serif\" font-size=\"11\" text-anchor=\"middle\">\n\
         <text x=\"{:.0}\" y=\"14\" textLength=\"{:.0}\">{left}</text>\n\
         <text x=\"{:.0}\" y=\"14\" textLength=\"{:.0}\">{right}</text>\n</g>\n</svg>\n",
        second - 3.0,
        second - 3.0,
        0.5 * first,
        first - 12.0,
        first + 0.5 * second,
        second - 12.0,
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The digest of the empty text, by `openssl dgst -sha256 -binary | base64`.
    #[test]
    fn a_script_has_the_source_that_browsers_compute() {
        let empty = "sha256-47DEQpj8HBSa+/TImW+5JCeuQeRkm5NMpJWZG3hSuFU=";
        assert_eq!(script_source(""), empty);
    }
}
