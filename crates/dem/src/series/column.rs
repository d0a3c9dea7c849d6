//! Columns of the result files of codes, each declared once.

/// A column of the rows `R` of a file.
#[derive(Debug)]
pub struct Column<R> {
    /// Name in the header.
    pub name: &'static str,
    /// Unit.
    pub unit: &'static str,
    /// Meaning, for the tables in the documents.
    pub meaning: &'static str,
    /// Whether a file may leave it out.
    pub is_optional: bool,
    /// Returns the value in a row.
    pub value: fn(&R) -> f64,
    /// Sets the value in a row; returns false if the column cannot hold that number.
    pub set: fn(&mut R, f64) -> bool,
}

/// A number in a row.
pub(super) trait Number: Copy {
    /// Converts `value` to this type; `None` if that is not exact.
    fn of(value: f64) -> Option<Self>;
}

impl Number for f64 {
    fn of(value: f64) -> Option<Self> {
        Some(value)
    }
}

impl Number for u64 {
    fn of(value: f64) -> Option<Self> {
        /// Up to here, doubles represent every whole number.
        const MOST: f64 = (1_u64 << f64::MANTISSA_DIGITS) as f64;
        let is_count = value.fract() == 0.0 && (0.0..=MOST).contains(&value);
        is_count.then_some(value as Self)
    }
}

/// Declares the rows of a file by their columns, in order: name, type, unit and meaning, and `optional` if a file may
/// leave the column out. One further field, with attributes of its own, is not a column.
macro_rules! columns {
    ($(#[$doc:meta])* $row:ident of $file:ident, $count:literal, and $(#[$more:meta])* $further:ident: $further_kind:ty:
     $($name:ident: $kind:ty, $unit:literal, $meaning:literal $(, $optional:ident)?;)*) => {
        $(#[$doc])*
        #[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
        #[serde(deny_unknown_fields)]
        pub struct $row {
            $(#[doc = $meaning] pub $name: $kind,)*
            $(#[$more])*
            pub $further: $further_kind,
        }

        impl $row {
            /// The columns, in order.
            #[allow(clippy::unnecessary_cast)] // All values but the step are floating-point numbers already.
            pub const COLUMNS: [super::column::Column<Self>; $count] = [$(super::column::Column {
                name: stringify!($name),
                unit: $unit,
                meaning: $meaning,
                is_optional: super::column::is_optional!($($optional)?),
                value: |row| row.$name as f64,
                set: |row, value| {
                    let number = <$kind as super::column::Number>::of(value);
                    number.map(|number| row.$name = number).is_some()
                },
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

/// Whether a column is declared `optional`.
macro_rules! is_optional {
    () => {
        false
    };
    (optional) => {
        true
    };
}

pub(super) use {columns, is_optional};
