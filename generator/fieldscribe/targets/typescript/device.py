"""The view of the main module: the class of the device, with its constructor's options."""

from __future__ import annotations

from fieldscribe.model import Device
from fieldscribe.targets.runtime_calls.class_facts import class_facts, readable_groups
from fieldscribe.targets.typescript.families import in_typescript
from fieldscribe.targets.typescript.identifiers import Identifiers, option, scope_of
from fieldscribe.targets.typescript.layout import Layout
from fieldscribe.text import camel, js_string

RUNTIME = "fieldscribe-runtime"


def device_context(device: Device, names: Identifiers) -> dict[str, object]:
    """Return the context of the main module: imports by module, facts of the class, and options."""
    family, scope = in_typescript(device), scope_of(device, names)
    layout = Layout(family.makers, camel)
    facts = {name.lower(): node for name, node in class_facts(scope).items()}
    facts |= {"version": device.version, "digest": device.digest}
    imports: dict[str, list[str]] = {}
    for name in sorted({family.device, "defineDevice", *map(layout.maker, scope.used)}):
        module = family.modules.get(name)
        imports.setdefault(f"{RUNTIME}/{module}" if module else RUNTIME, []).append(name)
    options = [(option(axis), " | ".join(map(js_string, values))) for axis, values in device.variants.items()]
    options += [(option(each.name), "number") for each in device.given]
    return {
        "name": names.device_class,
        "options": names.options,
        "base": family.device,
        "base_module": f"{RUNTIME}/{family.modules[family.device]}",
        "imports": sorted(imports.items()),
        "facts": [layout.laid_out(node, 2, f"{camel(name)}: ") for name, node in facts.items()],
        "choices": [(f"{name}?", kind) for name, kind in options],
        "settings": list(family.options),
        "device": js_string(device.id),
        "groups": " | ".join(map(js_string, readable_groups(device))) or "never",
    }
