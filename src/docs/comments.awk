# SPDX-License-Identifier: GPL-3.0-or-later
# Filter of Doxygen's input, for three things that it reads otherwise than the authors of the comments meant:
# - formulas and code are indented by four blanks more than their text; Markdown takes them for a block only
#   behind an empty line, which the sources leave out;
# - options such as --range become dashes where they are not in backquotes;
# - members of a private structure without a name count as public ones of the class.
function in_backquotes(comment,    parts, n, k, result) {
    n = split(comment, parts, "`")
    for (k = 1; k <= n; ++k) {
        if (k % 2 == 1) gsub(/--[a-z][a-zA-Z-]*/, "`&`", parts[k])
        result = result (k > 1 ? "`" : "") parts[k]
    }
    return result
}
/^ *struct \{$/ { unnamed = 1 }
unnamed {
    if ($0 ~ /^ *\} [a-z_]+;$/) unnamed = 0
    print ""
    next
}
{
    comment = $0 ~ /^ *\/\/\//
    block = $0 ~ /^ *\/\/\/     +[^ ]/
    if (comment && text_before && block != block_before) {
        match($0, /^ */)
        printf "%*s///\n", RLENGTH, ""
    }
    at = index($0, "///")
    print at && !block ? substr($0, 1, at - 1) in_backquotes(substr($0, at)) : $0
    text_before = comment && $0 ~ /\/\/\/ *[^ ]/
    block_before = block
}
