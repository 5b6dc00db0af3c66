# SPDX-License-Identifier: GPL-3.0-or-later
"""Whether the public members of classes have a docstring, by Doxygen's XML."""
import re
import xml.etree.ElementTree as ElementTree


def text_of(element):
    return "".join(element.itertext()).strip() if element is not None else ""


def is_documented(member):
    return text_of(member.find("briefdescription")) or text_of(member.find("detaileddescription"))


def needs_none(member, class_name):
    """Destructors, what is deleted, moves; and what overrides a function that says it."""
    name, arguments = member.findtext("name"), member.findtext("argsstring") or ""
    return (name.startswith("~") or "delete" in arguments or "&&" in arguments or member.find("reimplements") is not None
            or not name or class_name.startswith(name + "::"))


def undocumented(folder, reference):
    """A line for every public member without docstring of the classes that the page `reference` shows."""
    wanted = {re.sub(r"^spam::", "", name) for name in re.findall(r"doxygen(?:class|struct)}\s+([\w:]+)", reference)}
    found, complaints = set(), []
    for file in sorted(folder.glob("*.xml")):
        for compound in ElementTree.parse(file).getroot().iter("compounddef"):
            name = re.sub(r"\s*<.*", "", compound.findtext("compoundname", "").removeprefix("spam::"))
            if compound.get("kind") not in ("class", "struct") or name not in wanted:
                continue
            found.add(name)
            if not is_documented(compound):
                complaints.append(f"{name}: the class has no docstring")
            for section in compound.findall("sectiondef"):
                if not section.get("kind", "").startswith("public"):
                    continue
                for member in section.findall("memberdef"):
                    if not is_documented(member) and not needs_none(member, name):
                        where = member.find("location")
                        complaints.append(f"include/{where.get('file')}:{where.get('line')}: {name}::"
                                          f"{member.findtext('name')} has no docstring")
    complaints += [f"reference.md: there is no class {name}" for name in sorted(wanted - found)]
    return complaints
