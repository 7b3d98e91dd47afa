#!/bin/bash
# check_source_hashes.sh HASH_SOURCES_CMAKE: what changes the hash of a method and what does not, in an invented project.
set -euo pipefail

script=$1
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
folder=$scratch
cd "$folder"
mkdir -p adapters core/include/kernel core/include/polylidar core/src
printf '#include "adapters/shared.hpp"\n#include "adapters/linked.hpp"\n' >adapters/one.cpp
echo 'int linked();' >adapters/linked.hpp
printf '#include "adapters/linked.hpp"\n#include "polylidar/area.hpp"\n' >adapters/linked.cpp # in no list, as wkb.cpp
echo 'int area();' >core/include/polylidar/area.hpp
echo '#include "polylidar/area.hpp"' >core/src/area.cpp
echo '  #  include "kernel/kernel.hpp"  // deep' >adapters/shared.hpp
echo 'int kernel();' >core/include/kernel/kernel.hpp
printf '#include <vector>\n#include "private.hpp"\n#include "nowhere.hpp"\n' >core/src/kernel.cpp
echo '#include "private.hpp"' >core/src/private.hpp
echo 'int two();' >adapters/two.cpp
echo 'It decides nothing.' >adapters/PROTOCOL.md
printf '%s\n' "one|$folder/adapters/one.cpp|$folder/core/src/kernel.cpp" "two|$folder/adapters/two.cpp" >list.txt

# hash METHOD: of the sources as they are now.
hash() {
  cmake "-DROOT=$folder" "-DLIST=$folder/list.txt" "-DOUTPUT=$folder/hashes.hpp" "-DDEPFILE=$folder/hashes.d" \
    -P "$script"
  sed -n "s/^ *{\"$1\", \"\([0-9a-f]\{8\}\)\"},$/\1/p" hashes.hpp
}

fail() {
  echo "FAIL: $1" >&2
  exit 1
}

one=$(hash one)
two=$(hash two)
[ ${#one} -eq 8 ] && [ ${#two} -eq 8 ] && [ "$one" != "$two" ] || fail "two methods have the hashes '$one' and '$two'"
[ "$(hash one)" = "$one" ] || fail "the same sources have another hash"

for file in adapters/one.cpp adapters/shared.hpp adapters/linked.hpp adapters/linked.cpp \
  core/include/polylidar/area.hpp core/src/area.cpp core/include/kernel/kernel.hpp core/src/kernel.cpp \
  core/src/private.hpp; do
  grep -qF "$folder/$file" hashes.d || fail "the build is not told that $file was read"
  cp "$file" kept
  echo '// changed' >>"$file"
  [ "$(hash one)" != "$one" ] || fail "a change of $file leaves the hash as it was"
  [ "$(hash two)" = "$two" ] || fail "a change of $file changes a method that does not have it"
  cp kept "$file"
done
[ "$(hash one)" = "$one" ] || fail "taking the changes back does not bring the hash back"
echo '// changed' >>adapters/PROTOCOL.md
[ "$(hash one)" = "$one" ] || fail "a text that no source includes changes the hash"

mkdir elsewhere
cp -r adapters core elsewhere
sed -i "s#$folder/#$folder/elsewhere/#g" list.txt
folder=$folder/elsewhere
cp list.txt elsewhere
cd elsewhere
[ "$(hash one)" = "$one" ] || fail "the hash depends on the folder"
echo "the hash of a method changes with its sources and with nothing else"
