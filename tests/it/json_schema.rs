//! Whether a JSON is as a schema says; the tests of devices use this file, too.

use serde_json::Value;

/// What of a value is not as a schema says: the parts of JSON Schema that the schemas of this repository use.
pub fn violation(value: &Value, schema: &Value, root: &Value, at: &str) -> Option<String> {
    let here = |what: &str| Some(format!("{at}: {what}"));
    let is_of = |name: &Value| match name.as_str() {
        Some("object") => value.is_object(),
        Some("array") => value.is_array(),
        Some("string") => value.is_string(),
        Some("number") => value.is_number(),
        Some("integer") => value.is_i64() || value.is_u64(),
        Some("boolean") => value.is_boolean(),
        Some("null") => value.is_null(),
        _ => panic!("{name} is not checked"),
    };
    let is_type = match &schema["type"] {
        Value::Null => true,
        Value::Array(names) => names.iter().any(is_of),
        name => is_of(name),
    };
    if let Some(all) = schema["anyOf"].as_array()
        && all.iter().all(|one| violation(value, one, root, at).is_some())
    {
        return here(&format!("{value} is none of what it may be"));
    }
    let is_one = schema["enum"].as_array().is_none_or(|all| all.contains(value));
    if !is_type || !is_one || schema.get("const").is_some_and(|only| only != value) {
        return here(&format!("{value} is not what it should be"));
    }
    let number = value.as_f64().unwrap_or(0.0);
    let length = value.as_array().map_or(0.0, |items| items.len() as f64);
    for (least, most, size) in [("minimum", "maximum", number), ("minItems", "maxItems", length)] {
        if schema[least].as_f64().is_some_and(|v| size < v)
            || schema[most].as_f64().is_some_and(|v| size > v)
        {
            return here(&format!("{size} is out of range"));
        }
    }
    let mut required = schema["required"].as_array().into_iter().flatten();
    if let Some(name) = required.find(|name| value.get(name.as_str().unwrap()).is_none()) {
        return here(&format!("{name} is missing"));
    }
    // What else a value has to follow: the schema that this one names, and those of its parts.
    let named = schema["$ref"].as_str();
    let named = named.map(|name| root.pointer(name.trim_start_matches('#')).unwrap());
    let mut parts: Vec<_> =
        named.map(|schema| (value, schema, at.to_owned())).into_iter().collect();
    for (name, part) in value.as_object().into_iter().flatten() {
        match schema["properties"].get(name) {
            Some(schema) => parts.push((part, schema, format!("{at}/{name}"))),
            None if schema["additionalProperties"] == false => {
                return here(&format!("{name} is not known"));
            }
            None if schema["additionalProperties"].is_object() => {
                parts.push((part, &schema["additionalProperties"], format!("{at}/{name}")));
            }
            None => {}
        }
    }
    let items = schema.get("items").into_iter().flat_map(|schema| {
        let items = value.as_array().into_iter().flatten().enumerate();
        items.map(move |(i, item)| (item, schema, format!("{at}/{i}")))
    });
    parts.into_iter().chain(items).find_map(|(part, schema, at)| violation(part, schema, root, &at))
}

/// What of a JSON is not as the schema of this name says.
pub fn wrong(name: &str, value: &Value) -> Option<String> {
    let all: Value = serde_json::from_str(include_str!("../../docs/schema.json")).unwrap();
    let schema = &all["$defs"][name];
    assert!(schema.is_object(), "docs/schema.json has no {name}");
    violation(value, schema, &all, name)
}
