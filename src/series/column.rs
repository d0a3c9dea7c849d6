//! Columns of the files that codes deliver, each declared once.

/// One column of the rows `R` of a file.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Column<R> {
    pub(crate) name: &'static str,
    pub(crate) unit: &'static str,
    pub(crate) meaning: &'static str,
    pub(crate) value: fn(&R) -> f64,
}

/// Declares the rows of a file by their columns, in order: name, type, unit and meaning.
macro_rules! columns {
    ($(#[$doc:meta])* $row:ident of $file:ident, $count:literal:
     $($name:ident: $kind:ty, $unit:literal, $meaning:literal;)*) => {
        $(#[$doc])*
        #[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
        #[serde(deny_unknown_fields)]
        pub struct $row {
            $(#[doc = $meaning] pub $name: $kind,)*
        }

        impl $row {
            /// The columns, in order.
            #[allow(clippy::unnecessary_cast)] // All values but the step are floating-point numbers already.
            pub(crate) const COLUMNS: [super::column::Column<Self>; $count] = [$(super::column::Column {
                name: stringify!($name),
                unit: $unit,
                meaning: $meaning,
                value: |row| row.$name as f64,
            }),*];

            /// Whether every value is a finite number.
            pub fn is_finite(&self) -> bool {
                let mut columns = Self::COLUMNS.iter();
                columns.all(|column| (column.value)(self).is_finite())
            }
        }

        impl $file {
            /// Names of the columns, in order.
            pub const COLUMNS: [&'static str; $count] = [$(stringify!($name)),*];
        }
    };
}

pub(super) use columns;
