#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The graspd authors
# SPDX-License-Identifier: BSD-3-Clause
"""golden_code.py c|cpp: a program GOLDEN_FOLDER OUT_FOLDER that decodes every golden message by lcm-gen's code, writes its values
as JSON and encodes it again. These two languages cannot list a struct's members themselves, so this lists them."""
import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE / "golden"), str(HERE.parent / "integration")]
from make_golden import TOP, TYPES  # noqa: E402

COMMON = r"""
static void text(FILE *out, const char *s) {
  fputc('"', out);
  for (; *s; ++s) fprintf(out, *s == '"' || *s == '\\' ? "\\%c" : "%c", *s);
  fputc('"', out);
}
static FILE *file(const char *folder, const char *name, const char *mode) {
  char path[4096];
  snprintf(path, sizeof(path), "%s/%s", folder, name);
  FILE *f = fopen(path, mode);
  if (!f) exit(1);
  return f;
}
static unsigned char bytes[65536];
static int load(const char *folder, const char *name) {
  FILE *f = file(folder, name, "rb");
  const int size = (int)fread(bytes, 1, sizeof(bytes), f);
  fclose(f);
  return size;
}
static void store(const char *folder, const char *name, int size) {
  FILE *f = file(folder, name, "wb");
  fwrite(bytes, 1, (size_t)size, f);
  fclose(f);
}
"""
LANGUAGES = {
    "c": {"head": "#include <lcm/lcm.h>\n#include <stdio.h>\n#include <stdlib.h>\n", "include": '"graspd_{0}.h"',
          "type": "graspd_{0}", "text": "{0}", "decode": "graspd_{0}_decode(bytes, 0, size, &m)",
          "size": "graspd_{0}_encoded_size(&m)", "encode": "graspd_{0}_encode(bytes, 0, sizeof(bytes), &m)"},
    "cpp": {"head": "#include <cstdio>\n#include <cstdlib>\n", "include": '"graspd/{0}.hpp"',
            "type": "graspd::{0}", "text": "{0}.c_str()", "decode": "m.decode(bytes, 0, size)",
            "size": "m.getEncodedSize()", "encode": "m.encode(bytes, 0, sizeof(bytes))"},
}


def dump_one(language, kind, place):
    if kind in TYPES:
        return f"dump_{kind}(out, &{place});"
    if kind == "string":
        return f"text(out, {language['text'].format(place)});"
    if kind in ("double", "float"):
        return f'fprintf(out, "%.17g", {place});'
    return f'fprintf(out, "%lld", (long long){place});'


def dump(language, name):
    """A function that writes one type, its parts' functions being there."""
    lines = [f"static void dump_{name}(FILE *out, const {language['type'].format(name)} *m) {{"]
    for i, (kind, member, dimensions) in enumerate(TYPES[name].members):
        lines.append(f"  fputs(\"{',' if i else '{'}\\\"{member}\\\":\", out);")
        if dimensions:
            length = dimensions[0] if dimensions[0].isdigit() else f"m->{dimensions[0]}"
            lines += ["  fputc('[', out);", f"  for (int i = 0; i < {length}; ++i) {{", "    if (i) fputc(',', out);",
                      f"    {dump_one(language, kind, f'm->{member}[i]')}", "  }", "  fputc(']', out);"]
        else:
            lines.append("  " + dump_one(language, kind, f"m->{member}"))
    return "\n".join(lines + ["  fputs(\"}\", out);", "}"])


def in_order():
    """Parts before what they are parts of."""
    done = []

    def visit(name):
        for kind, _, _ in TYPES[name].members:
            if kind in TYPES:
                visit(kind)
        if name not in done:
            done.append(name)
    for name in TOP:
        visit(name)
    return done


def check(language, name):
    lines = ["  {", f'    const int size = load(argv[1], "{name}.bin");', f"    {language['type'].format(name)} m;",
             f"    if ({language['decode'].format(name)} != size) return 1;",
             f'    FILE *out = file(argv[2], "{name}.json", "w");', f"    dump_{name}(out, &m);", "    fclose(out);",
             "    for (int i = 0; i < size; ++i) bytes[i] = 0;",
             f"    if ({language['size'].format(name)} != size) return 1;",
             f'    store(argv[2], "{name}.bin", {language["encode"].format(name)});', "  }"]
    return "\n".join(lines)


def main():
    language = LANGUAGES[sys.argv[1]]
    includes = "".join(f"#include {language['include'].format(name)}\n" for name in TOP)
    functions = "\n".join(dump(language, name) for name in in_order())
    body = "\n".join(check(language, name) for name in TOP)
    print(f"{language['head']}{includes}{COMMON}{functions}\n"
          f"int main(int argc, char **argv) {{\n  if (argc != 3) return 2;\n{body}\n  return 0;\n}}")


if __name__ == "__main__":
    main()
