//! Entries of a store by what is asked of them.

use super::contents::{CodesOfToday, Content};
use super::store::EntryKind;
use std::time::SystemTime;

/// What entries have to be; all that is asked for must hold.
#[derive(Debug, Clone, Default)]
pub struct Selection {
    /// One of these kinds; any kind if there are none.
    pub kinds: Vec<EntryKind>,
    /// Of one of these codes; of any if there are none.
    pub codes: Vec<String>,
    /// Written before this moment.
    pub before: Option<SystemTime>,
    /// Of no use to this program and the codes as they are installed.
    pub outdated: bool,
}

impl Selection {
    /// Those of `contents` that are what is asked for; the codes of `today` say what is outdated.
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

/// Of `contents` the oldest, as many as have to go so that no more than `allowed` of `total` bytes are left.
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
