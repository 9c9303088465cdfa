# SPDX-License-Identifier: MIT
# frozen_string_literal: true

require 'digest/sha2' # of threads, only the first may load it
require 'fileutils'
require 'json'
require 'rbconfig'
require_relative 'build/inputs'

# What was found out of the same inputs is not found out again: a figure, or a verdict
# that was good. It stands in the user's cache, whatever folder the project is in:
#
#   remembered = Remembered.new('mutants', files: %w[src/**/* include/*], tools: Inputs.tool('gcc'))
#   remembered.of('src/pid/fixpid_pid.c') { 'what is remembered, or nil if it is not good' }
#
# The inputs are the files of the tree that the patterns find, from the project's folder,
# by their names and content; the tools, and what Ruby has loaded of the project; words; and
# the variables of the environment that compilers and tests listen to. What changes while the
# block runs was not its input, and nothing is remembered. A cache that cannot be read or
# written remembers nothing, and that is all.
#
# Only tools/test remembers verdicts: a test that is called by itself judges all that it is
# asked for. It sets FIXPID_TALLY, a file that gets a line for whatever was remembered: how
# many, when they were found out, of what. FIXPID_FRESH=yes finds out everything anew.
class Remembered
  ROOT = File.expand_path('../..', __dir__)
  DAYS_MOST = 30 # then it is forgotten
  SECONDS_OF_DAY = 86_400
  VARIABLES = /\A(?:FIXPID_(?!FRESH\z|TALLY\z)\w+|CI|SDCC\w*|SPDK|CBMC|JOBS|C|CXX|CPP|CC|LD|(?:C|CXX|CPP|LD|MAKE)FLAGS|C_INCLUDE_PATH|CPLUS_INCLUDE_PATH|
                     CPATH|LIBRARY_PATH|COMPILER_PATH|GCC_\w+|LD_\w+|LANG|LANGUAGE|LC_\w+|TZ|RUBY\w*|GEM_\w+|BUNDLE_\w+|CEEDLING\w*|CMAKE_\w+|
                     PKG_CONFIG\w*|PYTHON\w*|NODE_\w+|QEMU_\w+|\w+SAN_OPTIONS|GLIBC_TUNABLES|DESTDIR|SOURCE_DATE_EPOCH|
                     GIT_(?:DIR|WORK_TREE|CONFIG\w*))\z/x.freeze

  class << self
    # Where it stands, or nil where the user has no cache.
    def folder
      cache = ENV['XDG_CACHE_HOME'].to_s
      cache = "#{ENV['HOME']}/.cache" if cache.empty? && !ENV['HOME'].to_s.empty?
      cache.empty? ? nil : "#{cache}/fixpid/verdicts"
    end

    def in_tests?
      !ENV['FIXPID_TALLY'].to_s.empty?
    end

    # Removes what is old, and what was never finished.
    def sweep
      return unless folder

      Dir.glob('*/*.json*', base: folder).map { |name| "#{folder}/#{name}" }.each do |path|
        File.delete(path) if Time.now - File.mtime(path) > DAYS_MOST * SECONDS_OF_DAY
      rescue SystemCallError
        nil # another one has removed it, or it is not ours
      end
    end
  end

  # `what` is their plural, in what tools/test says; figures are `always` remembered.
  def initialize(kind, files: [], tools: [], words: [], what: 'checks', always: false)
    @kind = kind
    @active = always || Remembered.in_tests?
    @files = files
    @words = words
    @what = what
    @tools = @active && Inputs.digest([*tools, RbConfig.ruby].uniq)
  end

  # What is remembered of this name, or what the block gives, which is nil, an array, a
  # hash or a text. `checks` is how many that counts as: a number, or what gives it.
  def of(name, files: [], words: [], checks: 1)
    return yield unless @active

    key = key_of(name, files, words)
    found = fresh? ? nil : recall(key)
    if found
      tally(checks.respond_to?(:call) ? checks.call(found['value']) : checks, found['when'])
      return found['value']
    end

    value = yield
    write(key, name, value) unless value.nil? || key != key_of(name, files, words)
    value
  end

  private

  def fresh?
    ENV['FIXPID_FRESH'] == 'yes'
  end

  def key_of(name, files, words)
    variables = ENV.to_h.select { |variable, _| VARIABLES.match?(variable) }.sort
    loaded = [*$LOADED_FEATURES, File.expand_path($PROGRAM_NAME)].select { |path| path.start_with?("#{ROOT}/") }
    Digest::SHA256.hexdigest([@kind, name, RUBY_DESCRIPTION, @tools, @words, words, variables,
                              Inputs.tree(loaded.map { |path| path.delete_prefix("#{ROOT}/") }, ROOT), Inputs.tree(@files + files)].inspect)
  end

  def path_of(key)
    "#{Remembered.folder}/#{@kind}/#{key}.json"
  end

  # What stands there, if it is whole and not too old.
  def recall(key)
    return unless Remembered.folder

    found = JSON.parse(File.read(path_of(key), encoding: 'UTF-8'))
    age = Time.now.to_i - found['when']
    found if found['key'] == key && found['seal'] == seal(found) && age.between?(0, DAYS_MOST * SECONDS_OF_DAY)
  rescue SystemCallError, JSON::ParserError, NoMethodError, TypeError
    nil
  end

  # Of all that is in a record.
  def seal(found)
    Digest::SHA256.hexdigest(JSON.generate(found.slice('key', 'name', 'when', 'value')))
  end

  # A temporary name, as another run may write the same.
  def write(key, name, value)
    return unless Remembered.folder

    record = { 'key' => key, 'name' => name, 'when' => Time.now.to_i, 'value' => value }
    record['seal'] = seal(record)
    FileUtils.mkdir_p(File.dirname(path_of(key)))
    unfinished = "#{path_of(key)}.#{Process.pid}.#{Thread.current.object_id}"
    File.write(unfinished, JSON.generate(record))
    File.rename(unfinished, path_of(key))
  rescue SystemCallError, JSON::GeneratorError, EncodingError
    FileUtils.rm_f(unfinished) if unfinished # it is found out again
  end

  def tally(checks, at)
    File.write(ENV.fetch('FIXPID_TALLY'), "#{checks} #{at} #{@what}\n", mode: 'a') if Remembered.in_tests?
  rescue SystemCallError
    nil
  end
end
