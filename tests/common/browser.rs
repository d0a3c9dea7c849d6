//! Pages as a real browser lays them out.

use super::{Bench, json};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

const BROWSERS: [&str; 3] = ["chromium", "chromium-browser", "google-chrome"];
/// In the environment: a browser must be there.
const REQUIRED: &str = "TRISTACK_REQUIRE_BROWSER";

/// Measurements of a `page` by a browser; see tests/page_inspection.js.
pub fn inspected(page: &str, width: u32) -> Option<serde_json::Value> {
    let browser = browser()?;
    let bench = Bench::without_codes();
    let script = include_str!("../page_inspection.js");
    let page = without_policy(page);
    let page = page.replace("</body>", &format!("<script>{script}</script></body>"));
    let output = laid_out(&browser, &bench, &page, width);
    let dom = String::from_utf8_lossy(&output.stdout).into_owned();
    let found = dom.split("<pre id=\"inspection\">").nth(1);
    let found = found.and_then(|rest| rest.split("</pre>").next());
    let found = found
        .unwrap_or_else(|| panic!("no inspection: {}", String::from_utf8_lossy(&output.stderr)));
    Some(json(
        &found
            .replace("&lt;", "<")
            .replace("&gt;", ">")
            .replace("&amp;", "&"),
    ))
}

/// The `page` without its content security policy, which would stop the scripts of tests.
pub fn without_policy(page: &str) -> String {
    let mark = "<meta http-equiv=\"Content-Security-Policy\"";
    let (before, rest) = page.split_once(mark).expect("a page with a policy");
    let (_, after) = rest.split_once('>').expect("its end");
    format!("{before}{after}")
}

/// The document as `browser` prints it after the scripts of the page have run; no name is resolved.
pub fn laid_out(browser: &Path, bench: &Bench, page: &str, width: u32) -> Output {
    let path = bench.path("page.html");
    fs::write(&path, page).expect("a page");
    let profile = bench.path("profile");
    Command::new(browser)
        .args(["--headless", "--no-sandbox", "--disable-gpu", "--dump-dom"])
        .args([
            "--host-resolver-rules=MAP * ~NOTFOUND",
            "--virtual-time-budget=20000",
        ])
        .arg(format!("--window-size={width},1000"))
        .arg(format!("--user-data-dir={}", profile.display()))
        .arg(format!("file://{}", path.display()))
        .output()
        .expect("the browser starts")
}

pub fn browser() -> Option<PathBuf> {
    let path = std::env::var_os("PATH").unwrap_or_default();
    let found = std::env::split_paths(&path)
        .flat_map(|directory| BROWSERS.map(|name| directory.join(name)))
        .find(|path| path.is_file());
    if found.is_none() {
        assert!(
            std::env::var_os(REQUIRED).is_none(),
            "no browser among {BROWSERS:?}"
        );
        eprintln!("skipped: no browser among {BROWSERS:?}");
    }
    found
}
