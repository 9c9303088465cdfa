# SPDX-License-Identifier: MIT
# shellcheck shell=sh
# Sourced by tools/test: part_NAME for each part of test/parts.txt.

# The two forms of the arithmetic. A compiler's own macros choose; _PIC14 is
# XC8's name for a chip that has the narrow one of every controller. That one is
# without assembly, too, which an AVR has.
forms='wide narrow'
first_form=${forms%% *}

# The mixin text for a mode (pointer or object) and a form, in Ceedling's context
# test or gcov; object.yml has the rest of the mode without pointers.
mode_and_form() {
    printf ':defines:\n  :%s:\n    "*":\n      - UNITY_SUPPORT_64\n' "$3"
    [ "$2" = wide ] || printf '      - %s\n' _PIC14 FIXPID_NO_ASSEMBLY
    [ "$1" = pointer ] || ruby -r./tools/lib/modules -e \
        'puts "    /test_fixpid_(?!bits|.*_arith)/:", Modules.with_object.map { |name|
            "      - FIXPID_#{name.upcase}_OBJECT=#{name}_controller" }'
}

# run_mode NAME MODE FORM [MIXIN]: all unit tests so.
run_mode() {
    name=$1-$2-$3 text=$(mode_and_form "$2" "$3" test)
    [ "$2" = pointer ] || set -- "$@" test/unit/object.yml
    shift 3
    run_ceedling "$name" test:all "$text" "$@"
}

part_quick() {
    need clang clang-format pmccabe
    need_ceedling
    for mode in pointer object; do
        run_mode unit $mode "$first_form"
    done
    check_formats
    check 'warnings of src' ruby tools/lib/lint.rb --quick
    check 'rules of the proofs' ruby tools/lib/prove/harness_rules.rb
    check 'seeded faults' ruby tools/lib/faults/seed.rb
    check 'each unit test asserts' ruby tools/lib/test/asserts.rb
    check_documents
}

# The modules that are another text in the narrow form, as a pattern. What is not is tested in
# the first form; each week all tests run in both.
narrow_modules() {
    for module in src/*/; do
        set -- "$module"*.c
        [ ! -f "$1" ] || # nothing but headers
            [ "$(cc -E -P -Iinclude "$@")" = \
                "$(cc -E -P -Iinclude -D_PIC14 -DFIXPID_NO_ASSEMBLY "$@")" ] ||
            basename "$module"
    done | paste -sd '|' -
}

part_unit() {
    need cc:gcc :libc6-dev gcov:gcc gcovr
    need_ceedling
    for form in $forms; do
        modules='[a-z0-9_]+' task=gcov:all
        [ "$form" = "$first_form" ] ||
            modules=$(narrow_modules) task="gcov:pattern[fixpid_($modules)]"
        run_ceedling "coverage-$form" "$task" \
            "$(mode_and_form pointer "$form" gcov)
:gcov:
  :summaries: FALSE
  :gcovr:
    :report_include: \"^src/($modules)/\"
    :exclude_directories: \"build/(?!ceedling-coverage-$form(\$|/))\""
    done
}

# limits NAME SUM TERM OUTPUT SUM_8BIT TERM_8BIT: the tests of the limits, and of
# the products, whose bits depend on them.
limits() {
    for form in $forms; do
        chip=
        [ "$form" = wide ] || chip='
      - _PIC14'
        run_ceedling "limits-$1-$form" 'test:pattern[limits|an964.*arith]' \
            ":defines:
  :test:
    '*':$chip
      - FIXPID_AN964_SUM_LIMIT=$2
      - FIXPID_AN964_TERM_LIMIT=$3
      - FIXPID_AN964_OUTPUT_LIMIT=$4
      - FIXPID_AN964_8BIT_SUM_LIMIT=$5
      - FIXPID_AN964_8BIT_TERM_LIMIT=$6"
    done
}

part_limits() {
    need cc:gcc :libc6-dev
    need_ceedling
    limits least 1 1 1 1 1
    limits most 30000 255 1023 8191 127
}

part_fuzz() {
    runner test/fuzz/run daily
}

part_cores() {
    runner test/chips/cores/run daily
}

check_formats() {
    sources=$(find include src port sim examples test tools -name '*.[ch]')
    simulators=$(find sim test tools -name '*.cc' -o -name '*.hh')
    check_files clang-format "$sources $simulators" \
        clang-format --dry-run -Werror
}

part_lint() {
    need cc:gcc :libc6-dev clang clang-format clang-tidy cppcheck pmccabe \
        shellcheck ruby avr-gcc:gcc-avr :avr-libc
    check_formats
    scripts=$(grep -rlE '^(#!/bin/sh|# shellcheck shell=sh)' tools test .ci)
    check_files shellcheck "$scripts" shellcheck -x
    rubies=$(find tools test -name '*.rb')
    check_files 'syntax of' "$rubies" \
        ruby -e 'ARGV.each { |file| RubyVM::InstructionSequence.compile_file(file) }'
    check 'rules that the addon for MISRA has' ruby tools/lib/pages/docs/misra.rb
    count 'warnings, tidy and MISRA' '^ok ' '^FAILED ' ruby tools/lib/lint.rb
    check 'rules of the proofs' ruby tools/lib/prove/harness_rules.rb
    check 'each unit test asserts' ruby tools/lib/test/asserts.rb
}

part_consumers() {
    need cmake make ninja:ninja-build ruby
    runner test/use/consumers/run daily
    runner test/use/port_check/run daily
}

part_packages() {
    runner test/use/packages/run daily
}

part_firmware() {
    need clang
    need_sdcc
    runner test/use/firmware/run daily
    check 'tools/firmware' tools/firmware
    runner test/use/xc8_check/run daily
    runner test/use/notes/run daily
}

part_target() {
    runner test/chips/target/run daily
}

part_python() {
    runner test/use/python/run daily
}

part_site() {
    runner test/web/site/run daily
}

part_families() {
    runner test/chips/families/run
}

part_cost() {
    need ruby gpasm:gputils gcc g++ :libc6-dev avr-gcc:gcc-avr :avr-libc \
        :libsimavr-dev
    build_gpsim
    count 'bounds of known routines' '^ok ' '^FAILED ' ruby tools/bound/test/bounds.rb
    count 'stacks of known routines' '^ok ' '^FAILED ' ruby tools/bound/test/stacks.rb
    count 'what tools/cost tells' '^ok ' '^FAILED ' ruby test/tools/cost/changes.rb
    count 'tools/cost' '^ok ' '^FAILED ' tools/cost --daily
}

part_chip() {
    need_sdcc
    build_gpsim
    count 'tools/demo chip' ' ok$' ' FAILED$' tools/demo --verbose chip faults_chip
    count 'the co-simulation' '^ok ' '^FAILED ' tools/lib/build/cosim_check
}

part_demo() {
    need cmake ninja:ninja-build cc:gcc :libc6-dev ruby gnuplot:gnuplot-nox
    count 'what tools/demo reads' '^ok ' '^FAILED ' ruby test/tools/demo/readers.rb
    check 'without dpkg' without_packages tools/demo thermostat
    count 'tools/demo' ' ok$' ' FAILED$' tools/demo --verbose --check-docs
}

part_tuner() {
    runner test/web/tuner/run daily
}

check_documents() {
    need ruby gpasm:gputils cc:gcc :libc6-dev g++ avr-g++:gcc-avr :avr-libc
    check 'documentation' ruby tools/lib/pages/check_docs.rb
}

part_docs() {
    check_documents
    # shellcheck source=tools/lib/build/browser.sh
    . tools/lib/build/browser.sh
    need_node_modules
    check 'tables, links and headings' node "$browser/node_modules/.bin/markdownlint-cli2"
    check 'without dpkg' without_packages \
        sh -c '. tools/lib/setup.sh && need ruby cc:gcc :libc6-dev'
}

# The first command on a machine that has nothing.
part_bare() {
    runner test/tools/bare/run
}

part_gates() {
    need ruby cc:gcc tcc :libc6-dev clang clang-tidy cppcheck pmccabe g++ \
        avr-g++:gcc-avr :avr-libc gpasm:gputils dash node:nodejs npm
    need_ceedling
    need_sdcc # what a gate starts need not try it again
    for gate in test/tools/gates/*.rb; do
        case ${gate##*/} in
        gate.rb) ;;    # which they share
        mutants.rb) ;; # with what it judges
        *) count "$gate" '^ok ' '^FAILED ' ruby "$gate" ;;
        esac
    done
}

part_mutants() {
    need ruby cc:gcc tcc :libc6-dev
    need_ceedling
    count 'test/tools/gates/mutants.rb' '^ok ' '^FAILED ' ruby test/tools/gates/mutants.rb
    count 'mutants' '^ok ' '^FAILED ' ruby tools/lib/faults/mutants.rb
}

part_sanitize() {
    need clang :libclang-rt-14-dev
    need_ceedling
    run_mode sanitize object "$first_form" test/unit/sanitize/sanitize.yml
}

# Forms, chips, compilers and pages beside those that run daily.
part_variants() {
    need qemu-system-arm simavr avr-gcc:gcc-avr :avr-libc sdcc :sdcc-libraries sstm8:sdcc-ucsim \
        clang :libclang-rt-14-dev ld.lld:lld mspdebug timeout:coreutils cmake make ninja:ninja-build ruby \
        gpasm:gputils gcc g++ :libc6-dev :libsimavr-dev
    need_sdcc
    need_spdk
    need_ceedling
    build_gpsim
    limits seven-turns 29999 127 1022 8190 126
    limits eight-turns 256 128 999 64 127
    for form in $forms; do
        run_mode unit object "$form"
        run_mode sanitize pointer "$form" test/unit/sanitize/sanitize.yml
    done
    for path in use/consumers use/port_check use/packages use/firmware use/xc8_check use/notes \
        use/python chips/cores chips/target web/site web/tuner; do
        runner "test/$path/run" weekly
    done
}

part_long() {
    need ruby clang :libclang-rt-14-dev cmake ninja:ninja-build cc:gcc :libc6-dev gnuplot:gnuplot-nox
    need_sdcc
    build_gpsim
    runner test/fuzz/run
    count 'bounds of random loops' '^ok ' '^FAILED ' ruby tools/bound/test/random_loops.rb
    count 'the search for the worst step' '^ok ' '^FAILED ' ruby test/tools/cost/search.rb
    count 'tools/cost' '^ok ' '^FAILED ' tools/cost --check
    count 'tools/demo' ' ok$' ' FAILED$' tools/demo --verbose --whole --check-docs chip faults faults_chip faults_places guard
    count 'tools/demo --long' ' ok$' ' FAILED$' tools/demo --verbose --long --check-docs random_plants
}

# The runner, and what it runs in a few minutes.
part_proofs() {
    need ruby cc:gcc
    need_cbmc
    runner test/proof/run daily
    count 'tools/prove --quick' '^ok ' '^FAILED ' tools/prove --quick
}

part_prove() {
    need ruby cc:gcc
    runner test/proof/run weekly
    count 'tools/prove' '^ok ' '^FAILED ' tools/prove
    count 'tools/prove --eva' '^ok ' '^FAILED ' tools/prove --eva
    count 'tools/prove --assembly' '^ok ' '^FAILED ' tools/prove --assembly
}

part_windows() {
    runner test/use/windows/run
}

# As root, with a mirror of Debian.
part_newest() {
    runner test/tools/newest/run
}
