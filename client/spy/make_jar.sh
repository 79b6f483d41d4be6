#!/bin/sh
# SPDX-FileCopyrightText: 2026 The graspd authors
# SPDX-License-Identifier: BSD-3-Clause
# The jar of graspd's types with the check in it:  make_jar.sh LCM-GEN LCM.JAR LCMTYPES FOLDER
set -eu
lcm_gen=$1 lcm_jar=$2 types=$3 folder=$4
here=$(dirname "$(readlink -f "$0")")
rm -rf "$folder/java" "$folder/classes"
mkdir -p "$folder/java/graspd/spy" "$folder/classes"
"$lcm_gen" --java --jpath "$folder/java" "$types"/*.lcm
{
  echo 'package graspd.spy;'
  echo 'final class Types {'
  echo '  static final Class<?>[] ALL = {'
  for type in "$types"/*.lcm; do echo "    graspd.$(basename "$type" .lcm).class,"; done
  echo '  };'
  echo '}'
} >"$folder/java/graspd/spy/Types.java"
javac -nowarn -Xlint:none --release 11 -cp "$lcm_jar" -d "$folder/classes" "$folder"/java/graspd/*.java "$folder/java/graspd/spy/Types.java" "$here/Check.java"
jar --create --date=2026-01-01T00:00:00Z --file "$folder/graspd-types.jar" -C "$folder/classes" graspd
