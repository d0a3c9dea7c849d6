//! The order of versions.

const MONTHS: [&str; 12] = [
    "jan", "feb", "mar", "apr", "may", "jun", "jul", "aug", "sep", "oct", "nov", "dec",
];

/// Words that mark a pre-release.
const EARLY: [&str; 5] = ["dev", "pre", "alpha", "beta", "rc"];

/// Returns the numbers by which versions are ordered: year, month and day where a month is named, then all others as
/// they stand. A word for a pre-release counts as −1, and 0 ends every version, so that a pre-release comes before
/// its release.
pub(super) fn version_order(version: &str) -> Vec<i64> {
    let lower = version.to_lowercase();
    let mut words = words(&lower);
    let month = |word: &str| MONTHS.iter().position(|month| word.starts_with(month));
    let number = |word: &str| word.parse::<i64>().ok();
    let dated = words.windows(3).position(|three| {
        number(three[0]).is_some() && month(three[1]).is_some() && number(three[2]).is_some()
    });
    let mut order = Vec::new();
    if let Some(at) = dated {
        let date: Vec<&str> = words.drain(at..at + 3).collect();
        let month = month(date[1]).map(|index| index as i64 + 1);
        order.extend(
            [number(date[2]), month, number(date[0])]
                .into_iter()
                .flatten(),
        );
    }
    order.extend(words.iter().filter_map(|word| match EARLY.contains(word) {
        true => Some(-1),
        false => number(word),
    }));
    order.push(0);
    order
}

/// Returns the runs of digits and the runs of letters.
fn words(text: &str) -> Vec<&str> {
    let kind = |byte: u8| (byte.is_ascii_digit(), byte.is_ascii_alphabetic());
    let runs = text
        .as_bytes()
        .chunk_by(|one, next| kind(*one) == kind(*next));
    let runs = runs.filter(|run| run[0].is_ascii_alphanumeric());
    runs.filter_map(|run| std::str::from_utf8(run).ok())
        .collect()
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
            &["1.0-rc1", "1.0", "1.0.1", "1.1-dev", "1.1"],
            &[
                "stable_2Aug2023",
                "stable_29Aug2024",
                "stable_29Aug2024_update1",
            ],
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
