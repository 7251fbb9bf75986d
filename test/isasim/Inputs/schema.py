"""usage: schema.py SCHEMA CONFIG...: judges configurations by the schema, with the few
keywords of JSON schema that it uses."""
import json
import sys


def judge(value, schema, path):
    if schema["type"] == "object":
        assert isinstance(value, dict), f"{path}: expected an object"
        for key, member in value.items():
            assert key in schema["properties"], f"{path}.{key}: unknown key"
            judge(member, schema["properties"][key], f"{path}.{key}")
        assert schema["additionalProperties"] is False
        return
    if schema["type"] == "string":
        assert isinstance(value, str) and isinstance(schema["default"], str), path
        if "enum" in schema:
            assert value in schema["enum"] and schema["default"] in schema["enum"], f"{path}: {value}"
        return
    assert schema["type"] == "integer" and isinstance(value, int), path
    assert schema["minimum"] <= value <= schema["maximum"], f"{path}: {value} is out of range"
    assert value % schema.get("multipleOf", 1) == 0, f"{path}: {value} is no multiple"
    assert schema["minimum"] <= schema["default"] <= schema["maximum"], path


schema = json.load(open(sys.argv[1]))
for name in sys.argv[2:]:
    judge(json.load(open(name)), schema, "")
    print("valid:", name)
