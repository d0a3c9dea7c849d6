//! Selects entries of a store.

use super::contents::{CodesOfToday, Content};
use super::store::EntryKind;
use std::time::SystemTime;

/// Conditions on entries; all that are set must hold.
#[derive(Debug, Clone, Default)]
pub struct Selection {
    /// The entry is of one of these kinds; of any kind if there are none.
    pub kinds: Vec<EntryKind>,
    /// It is of one of these codes; of any code if there are none.
    pub codes: Vec<String>,
    /// It was written before this moment.
    pub before: Option<SystemTime>,
    /// It is of no use to this program and the codes as they are installed.
    pub outdated: bool,
}

impl Selection {
    /// Returns those `contents` that meet the conditions; the codes of `today` say what is outdated.
    pub fn of(&self, contents: Vec<Content>, today: &mut CodesOfToday) -> Vec<Content> {
        let chosen = contents
            .into_iter()
            .filter(|content| self.has(content, today));
        chosen.collect()
    }

    fn has(&self, content: &Content, today: &mut CodesOfToday) -> bool {
        let is_code = |code: &str| self.codes.iter().any(|own| own == code);
        (self.kinds.is_empty() || self.kinds.contains(&content.entry.kind))
            && (self.codes.is_empty() || content.code().is_some_and(is_code))
            && self.before.is_none_or(|before| content.entry.made < before)
            && (!self.outdated || today.is_outdated(content) == Some(true))
    }
}

/// Returns the oldest `contents`, as many as have to go so that at most `allowed` of `total` bytes are left.
pub fn oldest_beyond(mut contents: Vec<Content>, total: u64, allowed: u64) -> Vec<Content> {
    contents.sort_by(|one, other| {
        let key = |content: &Content| (content.entry.made, content.entry.kind);
        (key(one), &one.entry.name).cmp(&(key(other), &other.entry.name))
    });
    let mut left = total;
    contents.retain(|content| {
        let goes = left > allowed;
        if goes {
            left -= content.entry.bytes();
        }
        goes
    });
    contents
}
