//! Columns of a result under other names, as a manifest writes them: `wall_force = "f_top"`, or with a factor
//! `floor_n2 = { from = "fn2", factor = -1.0 }`.

use crate::model::PAPER_BODIES;
use crate::series::{ColumnSource, ColumnSources, MotionRow, Sample};
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::de::value::MapAccessDeserializer;
use serde::de::{Error, MapAccess, Visitor};
use serde::{Deserialize, Deserializer};
use std::borrow::Cow;
use std::collections::BTreeMap;
use std::fmt;

/// Number of bodies on the floor of the stack with the most columns.
const SPHERES: u8 = 5;

/// Reads columns, whose names must be those of a series or a motion.
pub(super) fn read_columns<'de, D: Deserializer<'de>>(
    deserializer: D,
) -> Result<ColumnSources, D::Error> {
    let written = BTreeMap::<Name, Written>::deserialize(deserializer)?;
    let columns = written.into_iter().map(|(name, written)| {
        let (from, factor) = (written.from, written.factor);
        (name.0, ColumnSource { from, factor })
    });
    Ok(columns.collect())
}

/// The name of a column.
#[derive(PartialEq, Eq, PartialOrd, Ord)]
struct Name(String);

impl<'de> Deserialize<'de> for Name {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let name = String::deserialize(deserializer)?;
        let series = [PAPER_BODIES, SPHERES].map(Sample::columns).into_iter();
        let motions = [false, true].map(MotionRow::columns).into_iter();
        let all = series.flatten().map(|column| column.name);
        let all = all.chain(motions.flatten().map(|column| column.name));
        let mut known: Vec<&str> = Vec::new();
        for name in all {
            if !known.contains(&name) {
                known.push(name);
            }
        }
        if known.contains(&name.as_str()) {
            return Ok(Self(name));
        }
        // In serde's words; its own constructor takes only static lists of names.
        let known = known.join("`, `");
        Err(Error::custom(format!(
            "unknown field `{name}`, expected one of `{known}`"
        )))
    }
}

/// A column as it is written.
pub(super) struct Written {
    from: String,
    factor: f64,
}

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct WithFactor {
    /// Name of the column in the result.
    from: String,
    /// Factor that makes its numbers those of tristack.
    #[serde(default = "one")]
    factor: f64,
}

fn one() -> f64 {
    1.0
}

impl JsonSchema for Written {
    fn schema_name() -> Cow<'static, str> {
        "Column".into()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        let with_factor = generator.subschema_for::<WithFactor>();
        json_schema!({ "anyOf": [{ "type": "string" }, with_factor] })
    }
}

impl<'de> Deserialize<'de> for Written {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(Reader)
    }
}

struct Reader;

impl<'de> Visitor<'de> for Reader {
    type Value = Written;

    fn expecting(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str("the name of a column, or { from = \"NAME\", factor = NUMBER }")
    }

    fn visit_str<E: Error>(self, name: &str) -> Result<Written, E> {
        Ok(Written {
            from: name.to_owned(),
            factor: one(),
        })
    }

    fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<Written, A::Error> {
        let WithFactor { from, factor } = WithFactor::deserialize(MapAccessDeserializer::new(map))?;
        Ok(Written { from, factor })
    }
}
