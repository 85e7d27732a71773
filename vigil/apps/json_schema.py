"""The part of JSON Schema that protocol/openapi.json uses, for tests."""

TYPES = {
    "object": dict, "array": list, "string": str, "boolean": bool, "number": (int, float), "integer": int,
}  # fmt: skip


def complaints(value, schema, document, place="it"):
    """Yields what is wrong with a value."""
    while "$ref" in schema:
        target = document
        for step in schema["$ref"].removeprefix("#/").split("/"):
            target = target[step]
        schema = target
    if value is None and schema.get("nullable"):
        return
    for one in schema.get("allOf", ()):
        yield from complaints(value, one, document, place)
    if "oneOf" in schema:
        fitting = [one for one in schema["oneOf"] if not list(complaints(value, one, document, place))]
        if len(fitting) != 1:
            yield f"{place}: fits {len(fitting)} of what it may be"
        return
    wanted = TYPES.get(schema.get("type"), object)
    if not isinstance(value, wanted) or (isinstance(value, bool) and wanted is not bool and wanted is not object):
        yield f"{place}: {value!r} is no {schema['type']}"
        return
    if "enum" in schema and value not in schema["enum"]:
        yield f"{place}: {value!r} is none of {schema['enum']}"
    if "minimum" in schema and value < schema["minimum"]:
        yield f"{place}: {value!r} is below {schema['minimum']}"
    if isinstance(value, list):
        if not schema.get("minItems", 0) <= len(value) <= schema.get("maxItems", len(value)):
            yield f"{place}: has {len(value)} entries"
        for index, entry in enumerate(value):
            yield from complaints(entry, schema.get("items", {}), document, f"{place}[{index}]")
    if isinstance(value, dict):
        properties = schema.get("properties", {})
        for name in schema.get("required", ()):
            if name not in value:
                yield f"{place}: has no {name}"
        for name, member in value.items():
            if name in properties:
                yield from complaints(member, properties[name], document, f"{place}.{name}")
            elif schema.get("additionalProperties") is False:
                yield f"{place}: has {name}, which is not described"
