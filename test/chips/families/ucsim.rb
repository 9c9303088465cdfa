# SPDX-License-Identifier: MIT
# frozen_string_literal: true

require_relative 'harness'

# A family of SDCC's in ucsim: the compiler's options and the linker's, the
# simulator with its options, the memory of its interface and of the mark, and
# what a cycle takes of the simulator's time; nil, where it shows no memory.
Ucsim = Struct.new(:name, :title, :controllers, :refused, :limits, :compiler, :linker, :simulator, :order, :interface,
                   :memory, :cycle_ns, keyword_init: true) do
  def run
    UcsimRun
  end

  def costs_listed?
    !cycle_ns.nil?
  end
end

# A run in ucsim. Its questions and answers go through files, and the times of the
# meter's mark are in a VCD file.
class UcsimRun < Run
  # What SDCC's areas are called where they are no RAM.
  CODE = /\A_?(?:CODE|CSEG|CONST|HOME|GSINIT|GSFINAL|INITIALIZER|CABS|XINIT|DABS|RSEG|HEADER|INITIALIZED_ROM)/.freeze
  # "Unreachable" is what the features of fixpid_pid leave out.
  WARNINGS = %w[--Werror --disable-warning 126].freeze
  NO_RAM = /\A(?:_?REG_BANK|SSEG|BSEG_BYTES)/.freeze

  def result(questions)
    asked = questions.of(controller, family.order)
    objects = build
    simulate(asked)
    given = File.exist?(path('answers')) ? File.binread(path('answers')) : ''
    Result.new(rows: asked.rows, steps: asked.steps, different: asked.different(given),
               flash: areas(objects.first).select { |name, _| name.match?(CODE) }.values.sum,
               ram: asked.object + fixed(objects), **costs(asked))
  end

  private

  def driver
    "test/chips/target/driver_#{controller}.c"
  end

  def path(name)
    "#{folder}/#{name}"
  end

  def compile(file, *more)
    object = path("#{File.basename(file, '.c')}.rel")
    Host.output('sdcc', *family.compiler, '--std-c99', *WARNINGS, *options, *more, '-c', file, '-o', object)
    object
  end

  # The library's objects, the controller's own first.
  def build
    objects = library.map { |file| compile(file) }
    others = [compile('test/chips/families/ucsim_main.c')]
    others += metered? ? [compile(redirected), compile('test/chips/families/ucsim_meter.c')] : [compile(driver)]
    Host.output('sdcc', *family.compiler, '--out-fmt-ihx', *family.linker, others.first, *objects, *others.drop(1),
                '-o', path('firmware.ihx'))
    objects
  end

  def areas(object)
    File.foreach(object).filter_map { |line| line =~ /^A (\S+) size (\h+)/ ? [$1, $2.hex] : nil }
        .each_with_object(Hash.new(0)) { |(name, size), sums| sums[name] += size }
  end

  # The library's own RAM. What may lie upon each other in small models counts, too.
  def fixed(objects)
    objects.take(1).sum { |one| areas(one).reject { |name, _| name.match?(CODE) || name.match?(NO_RAM) }.values.sum }
  end

  def metered?
    !family.cycle_ns.nil?
  end

  def metering
    mark = File.read(path('firmware.map'))[/^\s*(?:[CDX]:\s+)?(\h+)\s+_mark\b/, 1] or raise Host::Failure, 'no mark'
    ["set hw vcd[0] output \"#{path('times.vcd')}\"", "set hw vcd[0] add #{family.memory}[0x#{mark}]", 'set hw vcd[0] start']
  end

  # Where the driver does not do it.
  def poisoning
    ["fill #{family.memory} 0 #{family.interface[/0x\h+/].hex - 1} 0xa5"]
  end

  def simulate(asked)
    lines = ["file \"#{path('firmware.ihx')}\"", 'reset', *(metered? ? metering : poisoning), 'run', 'kill']
    File.write(path('commands'), lines.map { |line| "#{line}\n" }.join)
    Host.output('timeout', '600', *family.simulator, '-I',
                "if=#{family.interface},in=#{asked.questions},out=#{path('answers')}", '-C', path('commands'))
  end

  UNITS = { 'fs' => 1e-6, 'ps' => 1e-3, 'ns' => 1.0, 'us' => 1e3 }.freeze

  # Between a mark of 1 and the next one of 2.
  def costs(asked)
    return {} unless metered?

    unit = 1.0
    now = began = nil
    found = []
    File.foreach(path('times.vcd')) do |line|
      case line
      when /^\$timescale\s+(\d+)\s*([fpnu]s)/ then unit = $1.to_i * UNITS.fetch($2)
      when /^#(\d+)/ then now = $1.to_i
      when /^b0*1 / then began = now
      when /^b0*10 / then found << ((now - began) * unit / family.cycle_ns).round
      end
    end
    FileUtils.rm_f(path('times.vcd'))
    statistics(found, asked)
  end
end
