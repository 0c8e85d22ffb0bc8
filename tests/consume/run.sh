#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Installs the package, moves the tree, and builds and runs the programs of project/ against it:
#   run.sh shared|static
# From the environment: SOURCE_DIR BUILD_DIR CMAKE GENERATOR CC FC SHARED_LIBS SANITIZED PYTHON
# RESTITUTE, and WITH_ FILES CONTACT CVODE TABLE TABLE_FILES BEM FIT PYTHON FORTRAN OPENMP. The
# working directory is used up.
set -eu

kind=$1
if [ "$SANITIZED" = ON ]; then
    echo "skipped: an instrumented library binds its users to the sanitizers"
    exit 77
fi

fail() {
    echo "consume/$kind: $*" >&2
    exit 1
}

case $kind in
shared) wanted=ON ;;
static) wanted=OFF ;;
*) fail "'$kind' must be shared or static" ;;
esac
case $SHARED_LIBS in ON | TRUE | YES | 1) built=ON ;; *) built=OFF ;; esac

rm -rf other first second user user-all user-fortran missing
work=$(pwd)

# The build under test is installed where it is of the wanted kind; else another one is made.
if [ "$built" = "$wanted" ]; then
    installed_from=$BUILD_DIR
else
    installed_from=$work/other
    "$CMAKE" -S "$SOURCE_DIR" -B other -G "$GENERATOR" -DCMAKE_BUILD_TYPE=Release -DBUILD_SHARED_LIBS=$wanted \
        -DCMAKE_C_COMPILER="$CC" -DCMAKE_Fortran_COMPILER="$FC" -DRESTITUTE_FILES="$WITH_FILES" \
        -DRESTITUTE_CONTACT="$WITH_CONTACT" -DRESTITUTE_TABLE="$WITH_TABLE" -DRESTITUTE_TABLE_FILES="$WITH_TABLE_FILES" \
        -DRESTITUTE_CVODE="$WITH_CVODE" -DRESTITUTE_BEM="$WITH_BEM" -DRESTITUTE_FIT="$WITH_FIT" \
        -DRESTITUTE_FORTRAN="$WITH_FORTRAN" -DRESTITUTE_OPENMP="$WITH_OPENMP" \
        -DRESTITUTE_EXAMPLES=OFF
    "$CMAKE" --build other
fi
"$CMAKE" --install "$installed_from" --prefix "$work/first"
mv first second # whatever still points to the first place fails from here on
! grep -rIl "$work/first" second || fail "the files named above hold the path that the tree was installed to"
prefix=$work/second

echo "== licences"
copyright=$prefix/share/doc/restitute/copyright
grep -q "BSD 3-Clause License" "$copyright" || fail "$copyright does not name our licence"
if [ "$WITH_BEM" = OFF ]; then
    ! grep FFTW "$copyright" || fail "$copyright names a library that is not linked"
else
    grep -q "linked with FFTW" "$copyright" && grep -q "GPL-2+" "$copyright" || fail "$copyright does not name the GPL"
fi

if [ "$WITH_FIT" = OFF ]; then
    ! grep "GNU Scientific Library" "$copyright" || fail "$copyright names a library that is not linked"
else
    grep -q "GNU Scientific Library" "$copyright" && grep -q "GPL-3+" "$copyright" || fail "$copyright does not name GSL"
fi

echo "== find_package"
components=core
[ "$WITH_FILES" = OFF ] || components="core;files"
[ "$WITH_CONTACT" = OFF ] || components="$components;contact"
[ "$WITH_TABLE" = OFF ] || components="$components;table"
[ "$WITH_TABLE_FILES" = OFF ] || components="$components;table_files"
[ "$WITH_CVODE" = OFF ] || components="$components;cvode"
[ "$WITH_BEM" = OFF ] || components="$components;bem"
[ "$WITH_FIT" = OFF ] || components="$components;fit"
"$CMAKE" -S "$SOURCE_DIR/tests/consume/project" -B user -G "$GENERATOR" -DCMAKE_PREFIX_PATH="$prefix" \
    -DCMAKE_C_COMPILER="$CC" -DCONSUMER_COMPONENTS="$components"
"$CMAKE" --build user
# A static library lies in the program, and the folder of materials beside that is none.
[ "$kind" = shared ] || export RESTITUTE_MATERIALS="$prefix/share/restitute/materials"
user/consumer
user/consumer_cxx
[ "$WITH_FILES" = OFF ] || user/consumer_files "$SOURCE_DIR/src/materials/polyisobutylene.json"
[ "$WITH_CONTACT" = OFF ] || user/consumer_contact
[ "$WITH_TABLE" = OFF ] || user/consumer_table
if [ "$WITH_TABLE_FILES" != OFF ] && [ "$WITH_PYTHON" != OFF ]; then
    "$RESTITUTE" table build --material "$SOURCE_DIR/src/materials/steel.json" --radius 0.01 \
        --partner same --friction 0.2 --tolerance 1e-2 --output user/table.h5
    user/consumer_table_files user/table.h5
fi
[ "$WITH_CVODE" = OFF ] || user/consumer_cvode
[ "$WITH_BEM" = OFF ] || user/consumer_bem
[ "$WITH_FIT" = OFF ] || user/consumer_fit

echo "== find_package without components takes all that are installed"
"$CMAKE" -S "$SOURCE_DIR/tests/consume/project" -B user-all -G "$GENERATOR" -DCMAKE_PREFIX_PATH="$prefix" \
    -DCMAKE_C_COMPILER="$CC" -DCONSUMER_COMPONENTS=
[ "$WITH_FILES" = OFF ] || "$CMAKE" --build user-all --target consumer_files

if [ "$WITH_FORTRAN" != OFF ]; then
    echo "== find_package from Fortran alone"
    "$CMAKE" -S "$SOURCE_DIR/tests/consume/project_fortran" -B user-fortran -G "$GENERATOR" \
        -DCMAKE_PREFIX_PATH="$prefix" -DCMAKE_Fortran_COMPILER="$FC" \
        -DCONSUMER_COMPONENTS="$(echo "$components" | sed 's/core/fortran/; s/;/;fortran_/g')"
    "$CMAKE" --build user-fortran
    for consumer in user-fortran/consumer*; do
        case $consumer in
        *_table_files) "$consumer" user-fortran/table.h5 ;;
        *_files) "$consumer" "$SOURCE_DIR/src/materials/polyisobutylene.json" ;;
        *) "$consumer" ;;
        esac
    done

    echo "== the installed sources of the module, for another compiler than ours"
    (mkdir user-fortran/source && cd user-fortran/source && sources=$prefix/share/restitute/fortran &&
        "$FC" -c "$sources/restitute_types.f90" "$sources/restitute_texts.f90" "$sources/restitute_core.f90" \
            "$sources/restitute.f90" "$SOURCE_DIR/tests/consume/project_fortran/consumer.f90")

    echo "== the module is missed by its name where there is no Fortran"
    if "$CMAKE" -S "$SOURCE_DIR/tests/consume/project" -B missing -G "$GENERATOR" -DCMAKE_PREFIX_PATH="$prefix" \
        -DCMAKE_C_COMPILER="$CC" "-DCONSUMER_COMPONENTS=fortran" >missing.log 2>&1; then
        fail "find_package found the component fortran for a project without Fortran"
    fi
    grep "component not installed: fortran" missing.log || { cat missing.log; fail "the message does not name it"; }
    rm -rf missing
fi

echo "== a component that is not there is missed by its name"
if "$CMAKE" -S "$SOURCE_DIR/tests/consume/project" -B missing -G "$GENERATOR" -DCMAKE_PREFIX_PATH="$prefix" \
    -DCMAKE_C_COMPILER="$CC" "-DCONSUMER_COMPONENTS=core;nowhere" >missing.log 2>&1; then
    fail "find_package found the component nowhere"
fi
grep "component not installed: nowhere" missing.log || { cat missing.log; fail "the message does not name it"; }

echo "== pkg-config"
if ! command -v pkg-config >/dev/null; then
    echo "skipped: no pkg-config here"
    exit 0
fi
PKG_CONFIG_PATH=$(dirname "$(find "$prefix" -name restitute.pc)")
LD_LIBRARY_PATH=$(dirname "$PKG_CONFIG_PATH")
export PKG_CONFIG_PATH LD_LIBRARY_PATH
static=""
[ "$kind" = shared ] || static=--static
# shellcheck disable=SC2046 # lists of words
"$CC" -o user/by_pkg_config "$SOURCE_DIR/tests/consume/project/consumer.c" \
    $(pkg-config --cflags --libs $static restitute)
user/by_pkg_config
for component in table table_files; do
    [ -f "$PKG_CONFIG_PATH/restitute-$component.pc" ] || continue
    # shellcheck disable=SC2046
    "$CC" -o "user/${component}_by_pkg_config" "$SOURCE_DIR/tests/consume/project/consumer_$component.c" \
        $(pkg-config --cflags --libs $static "restitute-$component")
done
[ "$WITH_TABLE" = OFF ] || user/table_by_pkg_config
[ ! -f user/table.h5 ] || user/table_files_by_pkg_config user/table.h5
if [ "$WITH_FORTRAN" != OFF ]; then
    # shellcheck disable=SC2046
    "$FC" -o user/fortran_by_pkg_config "$SOURCE_DIR/tests/consume/project_fortran/consumer.f90" \
        $(pkg-config --cflags --libs $static restitute-fortran)
    user/fortran_by_pkg_config
    if [ "$WITH_TABLE_FILES" != OFF ]; then
        # shellcheck disable=SC2046
        "$FC" -o user/fortran_table_files_by_pkg_config \
            "$SOURCE_DIR/tests/consume/project_fortran/consumer_table_files.f90" \
            $(pkg-config --cflags --libs $static restitute-fortran_table_files)
        user/fortran_table_files_by_pkg_config user/fortran.h5
    fi
fi
if [ "$WITH_CVODE" != OFF ]; then
    # shellcheck disable=SC2046
    "$CC" -o user/cvode_by_pkg_config "$SOURCE_DIR/tests/consume/project/consumer_cvode.c" \
        $(pkg-config --cflags --libs $static restitute-cvode)
    user/cvode_by_pkg_config
fi
if [ "$WITH_BEM" != OFF ]; then
    # shellcheck disable=SC2046
    "$CC" -o user/bem_by_pkg_config "$SOURCE_DIR/tests/consume/project/consumer_bem.c" \
        $(pkg-config --cflags --libs $static restitute-bem)
    user/bem_by_pkg_config
fi
if [ "$WITH_FIT" != OFF ]; then
    # shellcheck disable=SC2046
    "$CC" -o user/fit_by_pkg_config "$SOURCE_DIR/tests/consume/project/consumer_fit.c" \
        $(pkg-config --cflags --libs $static restitute-fit)
    user/fit_by_pkg_config
fi
if [ "$WITH_FILES" != OFF ]; then
    # shellcheck disable=SC2046
    "$CC" -o user/files_by_pkg_config "$SOURCE_DIR/tests/consume/project/consumer_files.c" \
        $(pkg-config --cflags --libs $static restitute-files)
    user/files_by_pkg_config "$SOURCE_DIR/src/materials/polyisobutylene.json"
fi
packages=$(find "$prefix" -path '*-packages/restitute/__init__.py')
if [ "$kind" = shared ] && [ "$WITH_PYTHON" != OFF ]; then
    echo "== the installed command and the installed Python package find libraries and materials"
    unset LD_LIBRARY_PATH
    PYTHONDONTWRITEBYTECODE=1 second/bin/restitute pair --material steel --radius 0.01 --density 7800 --speed 0.1 --friction 0.1
    [ -n "$packages" ] || fail "no Python package is installed"
    PYTHONPATH=$(dirname "$(dirname "$packages")") PYTHONDONTWRITEBYTECODE=1 "$PYTHON" -c "
import restitute
steel = restitute.material('steel')
print(restitute.pair(steel, radius=0.01, density=7800, speed=0.1, angle=[0, 30], friction=0.1).ex)
assert restitute.__file__.startswith('$prefix')"
fi
