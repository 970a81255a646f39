# The project's comments as doxygen reads them, line for line. "/// name  text" tells of a parameter; "throws", "source" and
# the like head paragraphs; a comment behind "double a, b;" is for both; the version's inline namespace is not shown.

# Splits "int a = 0, b{1};  ///< text" into a declaration per name.
function split_declarators(line,    at, code, note, type, depth, part, out, i, c) {
    at = match(line, /; +\/\/\/</)
    if (!at) return line
    code = substr(line, 1, at - 1)
    note = substr(line, at + 1)
    if (code !~ /,/ || !match(code, /^ *(const )?[A-Za-z_:0-9]+(<[A-Za-z_:0-9, <>]*>)? \*?/)) return line
    type = substr(code, 1, RLENGTH)
    code = substr(code, RLENGTH + 1)
    if (code !~ /^[a-z_0-9]+( = |\{|,)/) return line
    out = part = ""
    depth = 0
    for (i = 1; i <= length(code); ++i) {
        c = substr(code, i, 1)
        if (c ~ /[({[]/) ++depth
        if (c ~ /[)}\]]/) --depth
        if (c == "," && depth == 0) {
            out = out type part "; /**<" substr(note, index(note, "<") + 1) " */ "
            part = ""
        } else
            part = part c
    }
    return out type part ";" note
}

{
    line = $0
    sub(/firstray::inline v0/, "firstray", line)
    if (line ~ /^ *\/\/\/ /) {
        indent = line
        sub(/\/\/\/.*/, "/// ", indent)
        text = line
        sub(/^ *\/\/\/ /, "", text)
        if (match(text, /^(throws|source|cost)  +/)) {
            word = toupper(substr(text, 1, 1)) substr(text, 2, index(text, " ") - 2)
            text = "\\par " word ":\\n " substr(text, RLENGTH + 1)
            gsub(/\\n/, "\n" indent, text)
            line = indent text
        } else if (match(text, /^returns  +/))
            line = indent "\\return " substr(text, RLENGTH + 1)
        else if (match(text, /^Real  +/))
            line = indent "\\tparam Real " substr(text, RLENGTH + 1)
        else if (match(text, /^[a-z_]+(, [a-z_]+)*  +[^ ]/)) {
            names = text
            sub(/  +.*/, "", names)
            gsub(/, /, ",", names)
            sub(/^[a-z_]+(, [a-z_]+)*  +/, "", text)
            line = indent "\\param " names " " text
        }
    } else
        line = split_declarators(line)
    print line
}
