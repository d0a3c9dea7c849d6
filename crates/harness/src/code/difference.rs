//! The first difference between two conventions.

use crate::model::ContactConvention;

/// Returns the first key in which `own` differs from `other`, with both values.
pub(super) fn difference(
    own: &ContactConvention,
    other: &ContactConvention,
) -> Option<(String, String, String)> {
    let arms = [
        ("pair", own.arms.pair, other.arms.pair),
        ("floor", own.arms.floor, other.arms.floor),
    ];
    if let Some((key, own, theirs)) = arms.into_iter().find(|(_, own, theirs)| own != theirs) {
        return Some((key.to_owned(), own.to_string(), theirs.to_string()));
    }
    if own.law != other.law {
        return Some(("law".to_owned(), own.law.to_string(), other.law.to_string()));
    }
    let values = |convention: &ContactConvention| {
        let value = serde_json::to_value(convention);
        value.expect("a convention has only named fields and finite numbers")
    };
    let (own, theirs) = (values(own), values(other));
    // A key that one of them leaves out, as it may at its default, is `null` there.
    let mut keys = [&own, &theirs]
        .into_iter()
        .flat_map(|value| value.as_object().into_iter().flatten());
    let (key, _) = keys.find(|(key, _)| own[*key] != theirs[*key])?;
    Some((key.clone(), plain(&own[key]), plain(&theirs[key])))
}

/// A value as it is written in a case file, without quotation marks.
fn plain(value: &serde_json::Value) -> String {
    match value {
        serde_json::Value::Null => "left out".to_owned(),
        serde_json::Value::String(text) => text.clone(),
        _ => value.to_string(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::Law;

    #[test]
    fn a_difference_of_laws_is_named_from_both_sides() {
        let [linear, hertz] = [Law::LINEAR, Law::HERTZ].map(ContactConvention::with_law);
        let (key, own, theirs) = difference(&linear, &hertz).unwrap();
        assert_eq!(key, "law");
        assert_eq!(
            (own, theirs),
            (Law::LINEAR.to_string(), Law::HERTZ.to_string())
        );
        assert!(difference(&hertz, &linear).is_some());
        assert_eq!(difference(&hertz, &hertz), None);
    }
}
