//! The atlas of the passports on file: what it finds, that its numbers are theirs, and its pages in a real browser.

use crate::common::browser::{browser, inspected, laid_out};
use crate::common::{Bench, files_below, json_rows, passports, project, standard_error};
use std::collections::{BTreeSet, HashMap};
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::OnceLock;
use tristack::study::atlas::{Atlas, NamedPassport, base_name, difference, meanings};
use tristack::study::convention::PassportFile;

fn on_file() -> PathBuf {
    project().join("reference/passports")
}

/// The site, made once for all tests.
fn site() -> &'static Path {
    static SITE: OnceLock<(Bench, PathBuf)> = OnceLock::new();
    let (_, path) = SITE.get_or_init(|| {
        let bench = Bench::without_codes();
        make(&bench, "site");
        let path = bench.path("site");
        (bench, path)
    });
    path
}

fn make(bench: &Bench, out: &str) {
    let verdicts = project().join("reference/verdicts");
    let (passports, verdicts) = (on_file().display().to_string(), verdicts.display());
    let line = format!("atlas --passports {passports} --verdicts {verdicts} --out {out}");
    bench.tristack(&line).assert().success();
}

fn page(name: &str) -> String {
    fs::read_to_string(site().join(name)).unwrap_or_else(|error| panic!("{name}: {error}"))
}

/// The faults of LAMMPS, and the versions in which they come and go, are found in the passports without being told what to
/// look at.
#[test]
fn every_change_of_a_version_is_found_and_nothing_else() {
    let atlas = Atlas::new(passports(&on_file()));
    let found = atlas.edges().into_iter().map(|edge| {
        let (before, after) = (&edge.before.passport, &edge.after.passport);
        let names: Vec<String> = edge
            .difference
            .changes
            .iter()
            .map(|own| own.name.clone())
            .collect();
        let versions = [&before.program.version, &after.program.version].map(String::clone);
        (after.style.clone(), versions, names)
    });
    let found: Vec<(String, [String; 2], Vec<String>)> = found.collect();
    let expected = [
        (
            "wall/gran granular hertz/material",
            "floor_normal_stiffness",
        ),
        ("wall/gran hertz/history", "floor_sliding_spring_memory"),
        (
            "wall/gran hooke/history",
            "floor_tangential_stiffness_exponent",
        ),
    ];
    assert_eq!(found.len(), expected.len(), "{found:?}");
    for ((style, versions, names), (expected, property)) in found.iter().zip(expected) {
        assert_eq!(style, expected);
        assert_eq!(
            versions,
            &["23 Jun 2022 - Update 4", "2 Aug 2023 - Update 3"]
        );
        assert!(names.iter().any(|name| name == property), "{names:?}");
    }
}

#[test]
fn the_passports_that_contradict_their_declaration_are_those_with_a_fault() {
    let atlas = Atlas::new(passports(&on_file()));
    let differing = atlas
        .passports
        .iter()
        .filter(|own| own.differing().next().is_some());
    let found: BTreeSet<(&str, &str)> = differing
        .map(|own| {
            (
                own.passport.style.as_str(),
                own.passport.program.version.as_str(),
            )
        })
        .collect();
    let since_2023 = [
        "2 Aug 2023 - Update 3",
        "29 Aug 2024 - Update 3",
        "22 Jul 2025 - Update 4",
    ];
    let until_2022 = ["29 Sep 2021 - Update 2", "23 Jun 2022 - Update 4"];
    let classic = ["wall/gran hooke/history", "wall/gran hertz/history"];
    let expected = classic
        .iter()
        .flat_map(|style| since_2023.map(|version| (*style, version)));
    let material = until_2022.map(|version| ("wall/gran granular hertz/material", version));
    assert_eq!(found, expected.chain(material).collect());
    let page = page("index.html");
    let differing = page
        .split_once("<h2 id=\"differing\">")
        .expect("a section")
        .1;
    for (style, version) in found {
        let style = style.replace('/', "&#x2f;");
        assert!(
            differing.contains(&style) && differing.contains(version),
            "{style}"
        );
    }
}

#[test]
fn the_same_passports_give_the_same_bytes() {
    let bench = Bench::without_codes();
    make(&bench, "again");
    let again = bench.path("again");
    let files = files_below(&again);
    assert_eq!(files, files_below(site()));
    for name in files {
        let same = fs::read(site().join(&name)).ok() == fs::read(again.join(&name)).ok();
        assert!(same, "{} differs", name.display());
    }
    // A directory with a site is made anew.
    make(&bench, "again");
}

/// What stands between two marks, everywhere in `text`.
fn between<'a>(text: &'a str, open: &'a str, close: &'a str) -> impl Iterator<Item = &'a str> {
    let parts = text.split(open).skip(1);
    parts.filter_map(move |rest| rest.split_once(close).map(|(inside, _)| inside))
}

/// What a cell says of a key or property of a passport.
fn expected(passport: &PassportFile, name: &str) -> String {
    let rounded = |value: f64| {
        ((value * 1e6).round() / 1e6 + 0.0)
            .to_string()
            .replace('-', "−")
    };
    let key = passport.key(name).map(|row| row.measured.clone());
    let property = passport.property(name);
    match (key, property) {
        (Some(Some(word)), _) => word.parse().map_or(word, rounded),
        (_, Some(row)) => row.measured.map_or_else(|| "unknown".to_owned(), rounded),
        _ => "unknown".to_owned(),
    }
}

#[test]
fn every_cell_of_the_site_is_that_of_the_passport_that_it_links_to() {
    let own: HashMap<String, NamedPassport> = passports(&on_file())
        .into_iter()
        .map(|own| (own.name.clone(), own))
        .collect();
    let mut compared = 0;
    for name in files_below(site()) {
        let name = name.to_string_lossy().into_owned();
        let is_overview = ["index", "code-", "property-"]
            .iter()
            .any(|start| name.starts_with(start));
        if !is_overview {
            continue;
        }
        for link in between(&page(&name), "<a href=\"", "</a>") {
            let Some((target, text)) = link.split_once("\">") else {
                continue;
            };
            let Some((passport, place)) = target.split_once(".html#") else {
                continue;
            };
            let Some(passport) = own.get(passport) else {
                continue;
            };
            // Lists of what differs link with the name, or the number of them, as text.
            let differing: Vec<&str> = passport.differing().collect();
            let counted = differing.first() == Some(&place) && text == differing.len().to_string();
            if text == place || counted {
                assert!(differing.contains(&place), "{name}: {target}");
            } else {
                assert_eq!(
                    text,
                    expected(&passport.passport, place),
                    "{name}: {target}"
                );
            }
            compared += 1;
        }
    }
    assert!(compared > 3000, "{compared}");
}

#[test]
fn every_number_on_the_page_of_a_passport_and_in_the_tables_is_in_its_file() {
    let rows = json_rows(&page("atlas.json"));
    let mut rows = rows.into_iter();
    let atlas = Atlas::new(passports(&on_file()));
    for own in &atlas.passports {
        let filed = fs::read(on_file().join(format!("{}.json", own.name))).expect("a passport");
        let copied = fs::read(site().join(format!("passports/{}.json", own.name)));
        assert!(copied.expect("a copy") == filed, "{}", own.name);
        let page = page(&format!("{}.html", own.name));
        let shown = between(&page, "<tr id=\"", "</tr>");
        let shown: HashMap<&str, Vec<&str>> = shown
            .filter_map(|row| row.split_once("\">"))
            .map(|(id, cells)| (id, between(cells, "<td>", "</td>").collect()))
            .collect();
        for row in &own.passport.convention {
            let cells = &shown[row.key.as_str()];
            assert_eq!(
                cells[1],
                row.measured.as_deref().unwrap_or("unknown"),
                "{}",
                row.key
            );
        }
        for row in &own.passport.properties {
            let entry = rows.next().expect("a row for every property");
            assert_eq!(entry["passport"], own.name);
            assert_eq!(entry["property"], row.property);
            assert_eq!(entry["measured"].as_f64(), row.measured);
            assert_eq!(entry["uncertainty"].as_f64(), row.uncertainty);
            let cells = &shown[row.property.as_str()];
            let Some(measured) = row.measured else {
                assert!(cells[1].starts_with("unknown"), "{cells:?}");
                continue;
            };
            let number = cells[1]
                .split(' ')
                .next()
                .expect("a number")
                .replace('−', "-");
            let number: f64 = number.parse().unwrap_or_else(|_| panic!("{cells:?}"));
            assert!(
                (number - measured).abs() <= 1e-8 * measured.abs(),
                "{cells:?}"
            );
        }
        let forces = between(&page, "<td class=\"number\">", "</td>");
        let forces: Vec<f64> = forces.filter_map(|cell| cell.parse().ok()).collect();
        for force in own.passport.arm_effects.iter().filter_map(|row| row.force) {
            let shown = |cell: &f64| (cell - force).abs() <= 1e-8 * force;
            assert!(
                forces.iter().any(shown),
                "{}: {force}: {forces:?}",
                own.name
            );
        }
        let badge = self::page(&format!("badges/{}.svg", own.name));
        let agreeing = own
            .passport
            .properties
            .iter()
            .filter(|row| row.verdict.as_str() == "agrees");
        let all = own.passport.properties.len();
        assert!(
            badge.contains(&format!("{} of {all} as declared", agreeing.count())),
            "{badge}"
        );
    }
    assert_eq!(rows.next(), None);
}

#[test]
fn every_row_of_the_problems_is_in_its_file_and_the_codes_agree() {
    let page = page("problems.html");
    let sections: Vec<&str> = page.split("<h2 id=\"").skip(1).collect();
    assert_eq!(sections.len(), 4);
    for section in sections {
        let name = section.split('"').next().expect("a name");
        let text = fs::read_to_string(site().join(format!("verdicts/{name}.json")));
        let rows = json_rows(&text.expect("the verdicts"));
        let (summary, shown) = section.split_once("<details>").expect("all rows");
        let shown: Vec<&str> = between(shown, "<tr><td>", "</tr>").collect();
        assert_eq!(shown.len(), rows.len());
        for (row, shown) in rows.iter().zip(shown) {
            assert!(shown.starts_with(row["code"].as_str().expect("a name")));
            assert!(shown.contains(row["verdict"].as_str().expect("a verdict")));
            let cells: Vec<&str> = between(shown, "<td class=\"number\">", "</td>").collect();
            for (cell, key) in cells.into_iter().zip([
                "stiffness",
                "mu",
                "yield_force",
                "reference_force",
                "error",
            ]) {
                let Some(value) = row[key].as_f64() else {
                    assert_eq!(cell, "–");
                    continue;
                };
                let cell: f64 = cell.parse().expect("a number");
                let tolerance = if key == "error" {
                    0.1 * value.abs()
                } else {
                    1e-6 * value.abs()
                };
                assert!((cell - value).abs() <= tolerance, "{key}: {shown}");
            }
        }
        for code in between(summary, "<tr><td>", "</tr>") {
            let numbers: Vec<usize> = between(code, "number\">", "</td>")
                .filter_map(|cell| cell.parse().ok())
                .collect();
            assert_eq!(numbers[0] + numbers[1], numbers[2], "{name}: {code}");
        }
    }
}

fn assert_no_dead_link(site: &Path) {
    let files: BTreeSet<String> = files_below(site)
        .iter()
        .map(|path| path.to_string_lossy().into_owned())
        .collect();
    let page = |name: &str| fs::read_to_string(site.join(name)).expect("a page");
    for name in files.iter().filter(|name| name.ends_with(".html")) {
        let text = page(name);
        for link in between(&text, "href=\"", "\"") {
            assert!(!link.contains("//"), "{name} links to {link}");
            let (file, place) = link.split_once('#').unwrap_or((link, ""));
            let file = if file.is_empty() { name } else { file };
            assert!(files.contains(file), "{name} links to {link}");
            let is_there = place.is_empty() || page(file).contains(&format!("id=\"{place}\""));
            assert!(is_there, "{name} links to {link}");
        }
    }
}

#[test]
fn no_link_leads_nowhere() {
    assert_no_dead_link(site());
}

/// One passport, one that is later, and one with a property that nobody knows.
#[test]
fn few_passports_make_a_whole_site_too() {
    let bench = Bench::without_codes();
    let native = native();
    fs::create_dir(bench.path("filed")).expect("a directory");
    let file = |text: Vec<u8>| {
        let own = NamedPassport::read(text).expect("a passport");
        let path = bench.path("filed").join(format!("{}.json", own.name));
        fs::write(path, &own.text).expect("a file");
        own.name
    };
    let first = file(native.text.clone());
    let mut document: serde_json::Value = serde_json::from_slice(&native.text).expect("JSON");
    document["date"] = "2100-01-01T00:00:00Z".into();
    let rows = document["properties"]["rows"].as_array_mut().expect("rows");
    rows[0]["property"] = "pair_novelty".into();
    let later = file(serde_json::to_vec_pretty(&document).expect("JSON"));
    bench
        .tristack("atlas --passports filed --out few")
        .assert()
        .success();
    assert_no_dead_link(&bench.path("few"));
    let index = fs::read_to_string(bench.path("few/index.html")).expect("a page");
    assert!(index.contains(&later) && !index.contains(&first));
    // A page that may have been cited stays.
    for name in [first, later] {
        assert!(bench.path(&format!("few/{name}.html")).is_file(), "{name}");
    }
    assert!(!bench.path("few/problems.html").exists());
}

#[test]
fn every_property_has_one_meaning() {
    let atlas = Atlas::new(passports(&on_file()));
    let meanings = meanings();
    let named: BTreeSet<&str> = meanings.iter().map(|own| own.name.as_str()).collect();
    assert_eq!(named.len(), meanings.len());
    let measured: BTreeSet<&str> = atlas
        .properties()
        .into_iter()
        .map(|name| base_name(name).0)
        .collect();
    let without: Vec<&&str> = measured.difference(&named).collect();
    assert!(without.is_empty(), "without a meaning: {without:?}");
    // A linear law is only found to grow in a mutant, and no code on file has a spring that nothing turns, forces that are
    // late, two radii or a mechanism beside the model.
    let unused: Vec<&&str> = named.difference(&measured).collect();
    assert_eq!(
        unused,
        [
            &"force_lag",
            &"limit_damping_share",
            &"local_damping",
            &"normal_stiffness_exponent",
            &"rolling_couple",
            &"space_spring_left_behind",
            &"spring_left_behind",
            &"spring_radius"
        ]
    );
}

#[test]
fn a_browser_shows_the_latest_versions_on_every_width_and_fetches_nothing() {
    let passport = passports(&on_file()).swap_remove(0).name;
    let names = [
        "index.html".to_owned(),
        "problems.html".to_owned(),
        "code-lammps.html".to_owned(),
        "property-torque-arm.html".to_owned(),
        "property-sliding-spring-memory.html".to_owned(),
        format!("{passport}.html"),
    ];
    for (width, name) in [1400, 500]
        .into_iter()
        .flat_map(|width| names.each_ref().map(|name| (width, name)))
    {
        let Some(found) = inspected(&page(name), width) else {
            return;
        };
        for (what, none) in [
            ("fetched", "[]"),
            ("overlaps", "[]"),
            ("cut", "[]"),
            ("sideways", "false"),
        ] {
            assert_eq!(
                found[what].to_string(),
                none,
                "{name} at width {width}: {what}"
            );
        }
    }
}

#[test]
fn the_overview_filters_its_rows_and_no_other_script_runs() {
    let Some(browser) = browser() else { return };
    let bench = Bench::without_codes();
    let page = page("index.html");
    assert!(!page.contains("<tr hidden"));
    let strange = "<script>document.title = 'strange'</script></body>";
    let output = laid_out(&browser, &bench, &page.replace("</body>", strange), 1400);
    let dom = String::from_utf8_lossy(&output.stdout);
    let hidden = between(&dom, "<tr data-latest=\"", ">");
    let (latest, earlier): (Vec<&str>, Vec<&str>) = hidden.partition(|row| row.starts_with("true"));
    assert!(latest.len() > 3 && earlier.len() > 3, "{dom}");
    assert!(earlier.iter().all(|row| row.contains("hidden")));
    assert!(!latest.iter().any(|row| row.contains("hidden")));
    assert!(
        dom.contains("<title>Atlas of contacts</title>"),
        "{}",
        &dom[..900]
    );
}

/// Names and versions are texts of somebody else: they become no markup, no formula of a spreadsheet, and no file
/// outside of the site or hidden in it.
#[test]
fn texts_of_a_passport_are_text_on_pages_in_tables_and_in_the_names_of_files() {
    let mut document: serde_json::Value = serde_json::from_slice(&native().text).expect("JSON");
    document["software"] = "../../x<script>alert(1)</script>".into();
    document["style"] = "=HYPERLINK(\"http://x\")".into();
    document["program"]["version"] = "$\\input{/etc/passwd}$".into();
    let text = serde_json::to_vec_pretty(&document).expect("JSON");
    let name = NamedPassport::read(text.clone()).expect("a passport").name;
    assert!(
        name.starts_with("x-script-alert-1-script_input-etc-passwd_hyperlink-http-x_"),
        "{name}"
    );
    let bench = Bench::without_codes();
    fs::create_dir(bench.path("filed")).expect("a directory");
    fs::write(bench.path(&format!("filed/{name}.json")), text).expect("a passport");
    let line = "atlas --passports filed --out site";
    bench.tristack(line).assert().success();
    let site = bench.path("site");
    for file in files_below(&site) {
        let name = file.to_string_lossy().into_owned();
        assert!(!name.contains("/.") && !name.starts_with('.'), "{name}");
        if name.ends_with(".html") {
            let page = fs::read_to_string(site.join(&file)).expect("a page");
            assert!(!page.contains("<script>alert"), "{name}");
            assert!(page.contains("Content-Security-Policy"), "{name}");
        }
    }
    let table = fs::read(site.join("atlas.csv")).expect("a table");
    let mut table = csv::Reader::from_reader(table.as_slice());
    let row = table.records().next().expect("a row").expect("CSV");
    assert_eq!(&row[3], "'=HYPERLINK(\"http://x\")");
}

/// A passport like one on file, with another number.
fn changed(own: &NamedPassport, place: &str, property: &str, value: f64) -> Vec<u8> {
    let mut document: serde_json::Value = serde_json::from_slice(&own.text).expect("JSON");
    let rows = document[place]["rows"].as_array_mut().expect("rows");
    let row = rows.iter_mut().find(|row| row["property"] == property);
    row.expect("the property")["measured"] = value.into();
    serde_json::to_vec_pretty(&document).expect("JSON")
}

fn native() -> NamedPassport {
    let mut all = passports(&on_file()).into_iter();
    all.find(|own| own.passport.code == "native")
        .expect("native has a passport")
}

#[test]
fn a_diff_tells_what_changed_by_how_much_and_what_it_does() {
    let bench = Bench::without_codes();
    let native = native();
    fs::write(bench.path("before.json"), &native.text).expect("a file");
    let same = bench
        .tristack("passport diff before.json before.json --format json")
        .assert()
        .code(0);
    let printed = String::from_utf8_lossy(&same.get_output().stdout).into_owned();
    assert!(printed.contains("30.227048"), "{printed}");

    let after = changed(&native, "properties", "floor_friction", 0.2 * (1.0 + 1e-3));
    fs::write(bench.path("after.json"), after).expect("a file");
    let output = bench
        .tristack("passport diff before.json after.json")
        .assert()
        .code(2);
    let output = output.get_output();
    let printed = String::from_utf8_lossy(&output.stdout).into_owned();
    assert!(
        printed.contains("floor_friction") && printed.contains("+2.0e-4"),
        "{printed}"
    );
    let message = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(
        message.contains("do not count that floor_friction changed"),
        "{message}"
    );

    // Below the tolerance of the probe nothing has changed.
    let after = changed(&native, "properties", "floor_friction", 0.2 * (1.0 + 1e-7));
    fs::write(bench.path("after.json"), after).expect("a file");
    bench
        .tristack("passport diff before.json after.json")
        .assert()
        .code(0);
}

/// A passport like one on file, with its rows of properties edited.
fn edited(own: &NamedPassport, edit: impl Fn(&mut Vec<serde_json::Value>)) -> Vec<u8> {
    let mut document: serde_json::Value = serde_json::from_slice(&own.text).expect("JSON");
    edit(document["properties"]["rows"].as_array_mut().expect("rows"));
    serde_json::to_vec_pretty(&document).expect("JSON")
}

#[test]
fn a_passport_that_contradicts_itself_is_refused_by_its_row() {
    let bench = Bench::without_codes();
    let native = native();
    fs::write(bench.path("before.json"), &native.text).expect("a file");
    let name = native.passport.properties[0].property.clone();
    let again = |rows: &mut Vec<serde_json::Value>| rows.push(rows[0].clone());
    let of = |key: &'static str, value: serde_json::Value| {
        edited(&native, |rows| rows[0][key] = value.clone())
    };
    for (text, words) in [
        (of("uncertainty", (-1.0).into()), "is -1, below 0"),
        (
            of("measured", serde_json::Value::Null),
            "has the verdict `agrees`, but no measured value",
        ),
        (
            of("verdict", "differs".into()),
            "but the passport as a whole `agrees`",
        ),
        (edited(&native, again), "stands there twice"),
    ] {
        fs::write(bench.path("after.json"), text).expect("a file");
        for line in [
            "passport diff before.json after.json",
            "passport diff after.json before.json",
        ] {
            let mut command = bench.tristack(line);
            let message = standard_error(&mut command);
            let named = format!("after.json: the uncertainty of `{name}`");
            let named = named.as_str();
            let plain = format!("after.json: `{name}` ");
            assert!(
                message.contains(words) && (message.contains(named) || message.contains(&plain)),
                "{message}"
            );
            command.assert().code(1);
        }
    }
    let other = changed(&native, "properties", "pair_torque_arm", 0.25);
    fs::write(bench.path("after.json"), other).expect("a file");
    let mut command = bench.tristack("passport diff before.json after.json");
    let message = standard_error(&mut command);
    let words = "but `pair_torque_arm`, the same arm, 0.25";
    assert!(message.contains(words), "{message}");
    command.assert().code(1);
}

#[test]
fn a_diff_that_could_not_see_a_difference_says_so() {
    let bench = Bench::without_codes();
    let native = native();
    fs::write(bench.path("before.json"), &native.text).expect("a file");
    let name = native.passport.properties[0].property.clone();
    let diff = |text: Vec<u8>, before: &str| {
        fs::write(bench.path("after.json"), text).expect("a file");
        let line = format!("passport diff {before}.json after.json");
        let output = bench.tristack(&line).output().expect("it runs");
        let message = String::from_utf8_lossy(&output.stderr).into_owned();
        (output.status.code(), message)
    };
    for lost in [1.0.into(), serde_json::Value::Null] {
        let coarse = edited(&native, |rows| rows[0]["uncertainty"] = lost.clone());
        fs::write(bench.path("coarse.json"), &coarse).expect("a file");
        let (status, message) = diff(coarse, "coarse");
        let named = format!("would hide a difference of a thousandth: {name}\n");
        assert!(message.contains(&named), "{message}");
        assert_eq!(status, Some(4), "{message}");
    }
    let unknown = edited(&native, |rows| {
        rows[0]["measured"] = serde_json::Value::Null;
        rows[0]["uncertainty"] = serde_json::Value::Null;
        rows[0]["verdict"] = "inconclusive".into();
    });
    fs::write(bench.path("coarse.json"), &unknown).expect("a file");
    let (status, message) = diff(unknown, "coarse");
    let named = format!("known to neither, and not compared: {name}\n");
    assert!(message.contains(&named), "{message}");
    assert_eq!(status, Some(0), "{message}");

    let mut document: serde_json::Value = serde_json::from_slice(&native.text).expect("JSON");
    for table in ["properties", "convention"] {
        document[table]["rows"] = serde_json::json!([]);
    }
    let empty = serde_json::to_vec(&document).expect("JSON");
    fs::write(bench.path("coarse.json"), &empty).expect("a file");
    let (status, message) = diff(empty, "coarse");
    assert!(message.contains("nothing was compared"), "{message}");
    assert_eq!(status, Some(4), "{message}");
}

#[test]
fn the_forces_of_a_diff_are_those_of_both_passports() {
    let all = passports(&on_file());
    let of = |code: &str| {
        let mut all = all.iter();
        &all.find(|own| own.passport.code == code)
            .expect("it has a passport")
            .passport
    };
    let found = difference(of("lammps"), of("yade"));
    let names: Vec<&str> = found.changes.iter().map(|own| own.name.as_str()).collect();
    for name in [
        "convention.coulomb_operand",
        "pair_torque_arm",
        "floor_kinematic_arm",
        "pair_pull",
    ] {
        assert!(names.contains(&name), "{names:?}");
    }
    assert_eq!(found.forces.len(), 3);
    for (own, effect) in found.forces.iter().zip(&of("yade").arm_effects) {
        assert_eq!(own.after, effect.force);
        let change = own
            .after
            .zip(own.before.force)
            .map(|(after, before)| after - before);
        assert_eq!(own.change, change);
        assert!(change < Some(-0.01), "{change:?}");
    }
}

#[test]
fn files_that_are_no_passports_are_refused_by_name() {
    let bench = Bench::without_codes();
    let native = native();
    fs::create_dir(bench.path("filed")).expect("a directory");
    let name = format!("filed/{}.json", native.name);
    fs::write(
        bench.path(&name),
        changed(&native, "properties", "mass", 2.0),
    )
    .expect("a file");
    fs::write(bench.path("other.json"), "{\"schema\": \"other/1\"}").expect("a file");
    fs::create_dir(bench.path("empty")).expect("a directory");
    for (line, words) in [
        (
            "atlas --passports filed --out out",
            "it was changed after it was filed, or renamed",
        ),
        (
            "atlas --passports empty --out out",
            "it holds no JSON file; accepted is a directory",
        ),
        ("atlas --passports absent --out out", "absent"),
        (
            "passport diff other.json other.json",
            "other.json: `schema` is `other/1`; accepted is tristack/passport/1",
        ),
        (
            "atlas --out out",
            "reference/passports: it is not here; accepted is",
        ),
        (
            "passport diff absent.json other.json",
            "cannot read absent.json",
        ),
        (
            "atlas --passports filed --out filed",
            "accepted is a new or empty directory",
        ),
    ] {
        let mut command = bench.tristack(line);
        let message = standard_error(&mut command);
        assert!(message.contains(words), "{line}: {message}");
        command.assert().code(1);
    }
}
