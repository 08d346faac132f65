"""add_keywords.py FOLDER RAW.pyi STUB.pyi: adds to nanobind's stub of FOLDER's module _core what nanobind cannot say:
the types of keywords that set members of Settings, Camera, View, MeasureRequest and CheckRequest, and names of types,
which the module has as texts.
"""

import re
import sys
from pathlib import Path


def keywords(name: str, stub: str, *classes: str) -> str:
    about = f"Keywords: the attributes of {' and '.join(classes)}."
    lines = [f"class {name}(TypedDict, total=False):", f'    """{about}"""', ""]
    for kind in classes:
        body = re.search(rf"^class {kind}:\n(.*?)(?=^\S)", stub, re.MULTILINE | re.DOTALL)[1]
        for member, taken in re.findall(r"def (\w+)\(self, arg: (.*), /\) -> None", body):
            if member not in ("width", "height"):  # arguments of their own
                lines.append(f"    {member}: {taken}")
    return "\n".join(lines)


sys.path.insert(0, sys.argv[1])
import _core  # noqa: E402

stub = Path(sys.argv[2]).read_text()
for name, value in vars(_core).items():
    if isinstance(value, str) and value.startswith("typing."):
        stub = re.sub(rf"^{name}: str = .*$", f"{name} = {value}", stub, flags=re.MULTILINE)
    if isinstance(value, dict):
        kind = type(next(iter(value.values()))).__name__
        stub = re.sub(rf"^{name}: dict = .*$", f"{name}: dict[str, {kind}]", stub, flags=re.MULTILINE)
parts = ["import typing\nfrom typing import TypedDict\n" + stub.strip(), keywords("SettingsKeywords", stub, "Settings"),
         keywords("ViewKeywords", stub, "Camera", "View"), keywords("MeasureKeywords", stub, "MeasureRequest"),
         keywords("CheckKeywords", stub, "CheckRequest")]
Path(sys.argv[3]).write_text("\n\n\n".join(parts) + "\n")
