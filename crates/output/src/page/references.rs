//! References to figures, tables and claims by their numbers.

use std::collections::BTreeMap;

/// The numbers of what a text refers to, by anchors such as `figure-scaling`.
#[derive(Debug, Default)]
pub(super) struct Numbers(BTreeMap<String, String>);

/// The beginning of a reference without words.
const OPEN: &str = "[](#";

impl Numbers {
    /// Adds the number of the thing `name` of a kind such as `figure`, under its anchor and in words such as `figure
    /// 3`.
    pub fn add(&mut self, kind: &str, name: &str, number: usize) {
        let anchor = format!("{kind}-{name}");
        self.0.insert(anchor, format!("{kind} {number}"));
    }

    /// Fills in the words of every reference such as `[](#figure-scaling)` in `text`; unknown references stay.
    pub fn put_into(&self, text: &str) -> String {
        let mut parts = text.split(OPEN);
        let mut whole = parts.next().unwrap_or_default().to_owned();
        for part in parts {
            let anchor = part.split(')').next().unwrap_or_default();
            let words = self.0.get(anchor).map_or("", String::as_str);
            whole += &format!("[{words}](#{part}");
        }
        whole
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn references_get_the_numbers_of_what_they_lead_to() {
        let mut numbers = Numbers::default();
        numbers.add("figure", "scaling", 2);
        let text = "as [](#figure-scaling) and [the table](#table-a) show";
        let expected = "as [figure 2](#figure-scaling) and [the table](#table-a) show";
        assert_eq!(numbers.put_into(text), expected);
    }
}
