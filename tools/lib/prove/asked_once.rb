# SPDX-License-Identifier: MIT
# What CBMC's programs ask gcc whenever they start.
require 'fileutils'
require 'tmpdir' # of threads, only the first may load it

# They ask for gcc's version, and once more for its C++, which costs more than many a proof's
# compilation. So the `gcc` that they find is a script which remembers the answer to a
# question, by all of its options and its text, as long as this program runs; whatever else
# they want of gcc, it starts.
module AskedOnce
  SCRIPT = <<~'SH'.freeze
    #!/bin/sh
    case $* in
    '-E - -o -') kept=$0.c ;;
    '-E -x c++ - -o -') kept=$0.cc ;;
    *) exec "$REAL_GCC" "$@" ;;
    esac
    asked= known= answer=
    while IFS= read -r line || [ -n "$line" ]; do
        asked="$asked$line
    "
    done
    [ ! -f "$kept" ] || . "$kept"
    [ -z "$known" ] || [ "$known" != "$asked" ] || {
        printf '%s\n' "$answer"
        exit 0
    }
    answer=$(printf '%s' "$asked" | "$REAL_GCC" "$@") || exit
    printf '%s\n' "$answer"
    case $asked$answer in
    *\'*) ;; # it would end the text
    *) printf "known='%s'\nanswer='%s'\n" "$asked" "$answer" >"$kept.$$" && mv "$kept.$$" "$kept" ;;
    esac
  SH

  module_function

  # The environment in which they find it.
  def environment
    @lock.synchronize { @environment ||= real ? { 'PATH' => "#{made}:#{ENV.fetch('PATH')}", 'REAL_GCC' => real } : {} }
  end

  def real
    ENV.fetch('PATH').split(':').map { |folder| File.expand_path('gcc', folder) }.find { |path| File.file?(path) && File.executable?(path) }
  end

  # The folder with the script, which goes when this program ends.
  def made
    folder = Dir.mktmpdir('asked_once')
    at_exit { FileUtils.rm_rf(folder) }
    File.write("#{folder}/gcc", SCRIPT)
    File.chmod(0o755, "#{folder}/gcc")
    folder
  end

  @lock = Mutex.new
end
