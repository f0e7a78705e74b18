"""As much of JSON Schema as the case file's schema uses; a word that is not known here is an error, so that nothing is
passed over."""


def mistakes(value, schema, place="case"):
    """Where a value, as tomllib reads it, does not fit a schema: a list of texts."""
    known = {
        "$schema",
        "title",
        "description",
        "type",
        "properties",
        "required",
        "additionalProperties",
        "propertyNames",
        "minProperties",
        "enum",
        "const",
        "minimum",
        "maximum",
        "exclusiveMinimum",
        "exclusiveMaximum",
        "items",
        "prefixItems",
        "minItems",
        "maxItems",
        "oneOf",
        "anyOf",
        "pattern",
    }
    unknown = set(schema) - known
    if unknown:
        raise ValueError(f"the schema has {unknown}, which is not known here")
    found = []

    def wrong(text):
        found.append(f"{place}: {text}")

    number = isinstance(value, (int, float)) and not isinstance(value, bool)
    kinds = {
        "object": isinstance(value, dict),
        "array": isinstance(value, list),
        "string": isinstance(value, str),
        "boolean": isinstance(value, bool),
        "number": number,
        "integer": number and float(value).is_integer()
        if number and value == value and abs(value) != float("inf")
        else False,
    }
    if "type" in schema and not kinds[schema["type"]]:
        wrong(f"is no {schema['type']}")
        return found
    if "enum" in schema and value not in schema["enum"]:
        wrong(f"is none of {schema['enum']}")
    if "const" in schema and value != schema["const"]:
        wrong(f"is not {schema['const']}")
    if number:
        for word, holds in (
            ("minimum", lambda a: value >= a),
            ("maximum", lambda a: value <= a),
            ("exclusiveMinimum", lambda a: value > a),
            ("exclusiveMaximum", lambda a: value < a),
        ):
            if word in schema and not holds(schema[word]):
                wrong(f"is {value}, {word} {schema[word]}")
        if value != value or abs(value) == float("inf"):
            wrong("is not finite")
    if isinstance(value, list):
        if not schema.get("minItems", 0) <= len(value) <= schema.get("maxItems", len(value)):
            wrong(f"has {len(value)} items")
        first = schema.get("prefixItems", [])
        for i, item in enumerate(value):
            found += mistakes(item, first[i] if i < len(first) else schema.get("items", {}), f"{place}[{i}]")
    if isinstance(value, dict):
        found += _object_mistakes(value, schema, place)
    if "anyOf" in schema and all(mistakes(value, one, place) for one in schema["anyOf"]):
        wrong(f"fits none of {schema['anyOf']}")
    if "oneOf" in schema:
        tried = [mistakes(value, one, place) for one in schema["oneOf"]]
        if sum(not one for one in tried) != 1:
            found += min(tried, key=len) if all(tried) else [f"{place}: fits several"]
    return found


def _object_mistakes(value, schema, place):
    import re
    found = [f"{place}: {name} is missing" for name in schema.get("required", []) if name not in value]
    if len(value) < schema.get("minProperties", 0):
        found.append(f"{place}: is empty")
    properties, others = schema.get("properties", {}), schema.get("additionalProperties", True)
    for name, item in value.items():
        pattern = schema.get("propertyNames", {}).get("pattern")
        if pattern and not re.search(pattern, name):
            found.append(f"{place}: the name {name!r}")
        if name in properties:
            found += mistakes(item, properties[name], f"{place}.{name}")
        elif others is False:
            found.append(f"{place}: {name} is not known")
        elif isinstance(others, dict):
            found += mistakes(item, others, f"{place}.{name}")
    return found
