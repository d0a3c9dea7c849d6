//! The order of versions.

const MONTHS: [&str; 12] = [
    "jan", "feb", "mar", "apr", "may", "jun", "jul", "aug", "sep", "oct", "nov", "dec",
];

/// The numbers by which versions are ordered: year, month and day where a month is named, then all others as they stand.
pub(super) fn version_order(version: &str) -> Vec<u64> {
    let lower = version.to_lowercase();
    let is_separator = |char: char| !char.is_ascii_alphanumeric();
    let words: Vec<&str> = lower
        .split(is_separator)
        .filter(|word| !word.is_empty())
        .collect();
    let month = |word: &str| MONTHS.iter().position(|month| word.starts_with(month));
    let dated = words.windows(3).position(|three| {
        let numbers = [three[0], three[2]].map(str::parse::<u64>);
        numbers.iter().all(Result::is_ok) && month(three[1]).is_some()
    });
    let mut order = Vec::new();
    let mut rest = words.clone();
    if let Some(at) = dated {
        let number = |word: &str| word.parse().unwrap_or(0);
        let name = month(words[at + 1]).map_or(0, |index| index as u64 + 1);
        order.extend([number(words[at + 2]), name, number(words[at])]);
        rest.drain(at..at + 3);
    }
    order.extend(rest.iter().filter_map(|word| {
        let digits = word.trim_matches(|char: char| !char.is_ascii_digit());
        digits.parse::<u64>().ok()
    }));
    order
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn versions_are_in_the_order_of_their_release() {
        for group in [
            &[
                "29 Sep 2021 - Update 2",
                "23 Jun 2022 - Update 4",
                "2 Aug 2023",
                "2 Aug 2023 - Update 3",
                "29 Aug 2024",
            ][..],
            &["9.5.2", "10.2.3", "10.3.1", "10.3.10"],
            &["2021.01a", "2023.02a", "2023.03a"],
            &["Python 3.9.2", "Python 3.11.7"],
        ] {
            let orders: Vec<_> = group.iter().map(|version| version_order(version)).collect();
            assert!(
                orders.is_sorted_by(|one, next| one < next),
                "{group:?}: {orders:?}"
            );
        }
    }
}
