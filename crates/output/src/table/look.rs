//! The look of a table on terminals, and the limits within which it is drawn.

/// The look of a table on terminals. Each list has one element per column; an empty list stands for `None` and `false`.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub(super) struct TerminalLook {
    /// The order in which a narrow terminal leaves the column out; `None` if it always stays.
    pub dispensable: Vec<Option<u8>>,
    /// Whether verdicts in the cells of a column are coloured.
    pub with_verdicts: Vec<bool>,
    /// Whether CSV and JSON have the columns that are left out.
    pub in_files: bool,
}

impl TerminalLook {
    pub fn has_verdicts(&self, column: usize) -> bool {
        self.with_verdicts.get(column).copied().unwrap_or(false)
    }
}

/// The width of a drawn table, and the minimum width of the content of each column.
pub(super) struct Limits {
    pub width: usize,
    pub least: Vec<usize>,
}
