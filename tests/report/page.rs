//! The page of the report as people see it: links, mathematics, filters, widths, print.

use super::common::Bench;
use super::common::browser::{browser, inspected, laid_out, without_policy};
use super::{file, message, report};
use std::collections::BTreeSet;
use std::process::Command;

/// Pages of the printed report.
const MOST_PAGES: usize = 20;

/// The values of an attribute in a page.
fn attributes<'a>(page: &'a str, name: &str) -> Vec<&'a str> {
    let mark = format!(" {name}=\"");
    let parts: Vec<&str> = page.split(mark.as_str()).skip(1).collect();
    let values = parts.into_iter().filter_map(|part| part.split('"').next());
    values.collect()
}

/// The text of a page without code, scripts, style and drawings, in which mathematics is cut out.
fn running_text(page: &str) -> String {
    let mut text = page.to_owned();
    for element in ["style", "script", "svg", "code", "math"] {
        let (open, close) = (format!("<{element}"), format!("</{element}>"));
        while let Some(start) = text.find(&open) {
            let end = text[start..].find(&close).expect("a closed element");
            text.replace_range(start..start + end + close.len(), " ");
        }
    }
    let mut inside = false;
    text.retain(|char| {
        inside = char == '<' || inside && char != '>';
        !inside && char != '>'
    });
    text.replace("&lt;", "<")
        .replace("&gt;", ">")
        .replace("&amp;", "&")
}

#[test]
fn every_link_leads_somewhere() {
    let page = file("report.html");
    let anchors: BTreeSet<&str> = attributes(&page, "id").into_iter().collect();
    let links = attributes(&page, "href");
    assert!(links.len() > 300, "{} links", links.len());
    for link in links {
        match link.strip_prefix('#') {
            Some(anchor) => assert!(anchors.contains(anchor), "no {anchor} on the page"),
            None if link.starts_with("https://arxiv.org/abs/") => {}
            None => {
                let path = report().0.path("report").join(link);
                assert!(path.is_file(), "{link} is no file of the report");
            }
        }
    }
    assert!(page.contains("href=\"https://arxiv.org/abs/2511.06807\""));
}

#[test]
fn every_claim_figure_table_and_equation_has_an_anchor_and_a_number() {
    let page = file("report.html");
    let anchors: BTreeSet<&str> = attributes(&page, "id").into_iter().collect();
    let count = |kind: &str| {
        anchors
            .iter()
            .filter(|anchor| anchor.starts_with(kind))
            .count()
    };
    let claims = super::json_rows(&file("claims.json")).len();
    assert_eq!(count("claim-"), claims);
    assert_eq!(
        count("equation-"),
        52,
        "17 of the text, 12 of the End Matter, 23 of the supplement"
    );
    let pictures = super::files_below(&report().0.path("report/figures")).len() / 2;
    assert_eq!(count("figure-"), pictures);
    for number in 1..=pictures {
        assert!(
            page.contains(&format!("<b>Figure {number}.</b>")),
            "figure {number}"
        );
    }
    let tables = super::files_below(&report().0.path("report/tables")).len();
    assert_eq!(count("table-"), tables);
    for number in 1..=tables {
        assert!(
            page.contains(&format!("<b>Table {number}.</b>")),
            "table {number}"
        );
    }
    let errata = count("erratum-");
    assert!(errata > 0);
    assert_eq!(page.matches("(<a href=\"#erratum-").count(), errata);
}

#[test]
fn running_text_has_mathematics_in_place_of_its_source() {
    for name in ["report.html", "gallery.html"] {
        let text = running_text(&file(name));
        for relic in [
            "$", "mu_c", "mu_d", "sqrt", "epsilon", "Theta(", "k_n", "kₙ", "z_star", ">~", "+-",
            "\\",
        ] {
            let found = text.find(relic).map(|at| {
                let start = text[..at]
                    .char_indices()
                    .rev()
                    .nth(60)
                    .map_or(0, |(at, _)| at);
                text[start..].chars().take(140).collect::<String>()
            });
            assert_eq!(found, None, "{relic} in the text of {name}");
        }
    }
}

#[test]
fn every_row_of_a_markdown_table_has_the_cells_of_its_head() {
    let page = file("report.md");
    let cells = |line: &str| line.replace("\\|", "").matches('|').count();
    let mut head: Option<usize> = None;
    for line in page.lines() {
        match (line.starts_with('|'), head) {
            (true, Some(count)) => assert_eq!(cells(line), count, "{line}"),
            (true, None) => head = Some(cells(line)),
            (false, _) => head = None,
        }
    }
    assert!(
        page.matches("\n|--").count() > 10 || page.contains("\n|-"),
        "there are tables"
    );
}

#[test]
fn claims_that_do_not_hold_come_first_and_can_be_shown_alone() {
    let page = file("report.html");
    let order: Vec<&str> = attributes(&page, "class")
        .into_iter()
        .filter_map(|class| class.strip_prefix("is-"))
        .collect();
    let mut verdicts = order.clone();
    verdicts.dedup();
    assert_eq!(verdicts, ["fails", "approximately", "holds", "untestable"]);
    for verdict in verdicts {
        let only = page.replace(
            &format!("id=\"show-{verdict}\""),
            &format!("id=\"show-{verdict}\" checked"),
        );
        let only = only.replace("id=\"show-all\" checked", "id=\"show-all\"");
        let Some(found) = inspected(&only, 1400) else {
            return;
        };
        let own = order.iter().filter(|one| **one == verdict).count();
        assert_eq!(found["shown"], own, "{verdict}");
    }
    let found = inspected(&page, 1400).expect("a browser");
    assert_eq!(found["shown"], order.len());
}

#[test]
fn a_narrow_page_scrolls_down_alone_and_its_figures_can_be_read() {
    let Some(found) = inspected(&file("report.html"), 500) else {
        return;
    };
    let none = serde_json::json!([]);
    assert_eq!(found["sideways"], false);
    assert_eq!(found["cut"], none);
    assert_eq!(found["small"], none, "letters of less than eight pixels");
}

#[test]
fn the_printed_report_has_less_than_twenty_pages() {
    let Some(browser) = browser() else { return };
    let bench = Bench::without_codes();
    let (page, pdf) = (bench.path("page.html"), bench.path("page.pdf"));
    std::fs::write(&page, file("report.html")).expect("a page");
    let output = Command::new(browser)
        .args([
            "--headless",
            "--no-sandbox",
            "--disable-gpu",
            "--no-pdf-header-footer",
        ])
        .arg(format!(
            "--user-data-dir={}",
            bench.path("profile").display()
        ))
        .arg(format!("--print-to-pdf={}", pdf.display()))
        .arg(format!("file://{}", page.display()))
        .output()
        .expect("the browser starts");
    let pdf = std::fs::read(&pdf).unwrap_or_else(|error| panic!("{error}: {output:?}"));
    let text = String::from_utf8_lossy(&pdf);
    let pages = text.matches("/Type /Page\n").count() + text.matches("/Type /Page/").count();
    assert!(pages > 5, "{pages} pages are found in {} bytes", pdf.len());
    assert!(pages < MOST_PAGES, "{pages} pages");
}

#[test]
fn the_last_lines_say_why_the_exit_status_is_what_it_is() {
    let (message, status) = (message(), report().1.status.code().expect("a status"));
    let (_, reasons) = message
        .split_once(&format!("exit status {status}: "))
        .unwrap_or_else(|| panic!("{message}"));
    let claims = file("tables/agreement.csv");
    let rows = csv::Reader::from_reader(claims.as_bytes())
        .deserialize()
        .map(|row| row.expect("a row"))
        .map(
            |row: std::collections::HashMap<String, String>| -> [usize; 2] {
                ["rows", "agreeing"].map(|column| row[column].parse().expect("a count"))
            },
        )
        .fold([0, 0], |[rows, agreeing], [own, own_agreeing]| {
            [rows + own, agreeing + own_agreeing]
        });
    assert!(
        reasons.contains(&format!(" of {} rows", rows[0])),
        "{reasons}"
    );
    let named = reasons
        .lines()
        .filter(|line| line.contains(": inconclusive"))
        .count();
    assert_eq!(named > 0, status == 4, "{reasons}");
    assert!(laid(&message, reasons), "{message}");
}

/// Whether `last` are the last lines of `all` but for the path of the page.
fn laid(all: &str, last: &str) -> bool {
    all.ends_with(last) && last.lines().count() < 15
}

#[test]
fn a_dark_page_is_dark_and_its_figures_stay_on_paper() {
    let Some(browser) = browser() else { return };
    let bench = Bench::without_codes();
    let probe = "<script>addEventListener('load', () => { const pre = document.createElement('pre'); pre.id = 'colours'; \
                 const of = (element) => getComputedStyle(element); \
                 pre.textContent = [of(document.body).backgroundColor, of(document.body).color, \
                 of(document.querySelector('figure svg')).backgroundColor].join(' / '); document.body.append(pre); });</script></body>";
    let page = without_policy(&file("report.html")).replace("</body>", probe);
    let dark = page.replace("(prefers-color-scheme: dark)", "(min-width: 1px)");
    for (page, expected) in [
        (
            &page,
            "rgb(255, 255, 255) / rgb(26, 26, 26) / rgb(255, 255, 255)",
        ),
        (
            &dark,
            "rgb(23, 24, 26) / rgb(230, 230, 227) / rgb(255, 255, 255)",
        ),
    ] {
        let output = laid_out(&browser, &bench, page, 1400);
        let dom = String::from_utf8_lossy(&output.stdout);
        assert!(
            dom.contains(expected),
            "{:?}",
            dom.split("id=\"colours\">").nth(1)
        );
    }
}
