# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# Bits that flip in a chip elsewhere than in the controller's object, at any moment of a
# tick: the port's variables, the application's, the registers of the CPU, the stack.
module FaultPlaces
  NAMES = { 'port' => "the port's variables", 'application' => 'all other variables',
            'registers' => "the CPU's registers", 'stack' => 'the stack in use' }.freeze
  # Of each place, how many flips; and what the firmware is.
  CHIPS = { 'pendulum' => 'the pendulum, PIC16F684', 'motor' => 'the motor, PIC18F4520',
            'motor_atmega328p' => 'the motor, ATmega328P' }.freeze
  RUNS = 16
  LONG_RUNS = 40

  # W, which has no address, is FFFF to the simulation; the others are STATUS, FSR and
  # PCLATH of a PIC16; WREG, STATUS, BSR, three FSRs, PROD, TBLPTR and PCLATH of a PIC18;
  # r0 to r31, SP and SREG of an AVR. The program counter is in none of them.
  REGISTERS = { 'pic16f684' => 'ffff,3,4,a', 'pic18f4520' => 'fe8,fd8,fe0,fe9-fea,fe1-fe2,fd9-fda,ff3-ff4,ff6-ff8,ffa-ffb',
                'atmega328p' => '0-1f,5d-5f' }.freeze
  # Flips in TRISC, T2CON or TCCR1B stop the drive, so that those which never arrive are
  # noticed.
  DRIVE = { 'pic16f684' => '87', 'pic18f4520' => 'fca', 'atmega328p' => '81' }.freeze
  DRIVE_RUNS = 8
  AVR_STACK = 'stack:5d:8ff'

  class << self
    # { place => bytes } of a firmware, as its program takes them.
    def of(path, chip)
      ram = path.end_with?('.elf') ? of_avr(path) : of_pic(path.sub(/cod\z/, 'map'))
      ram.merge('registers' => REGISTERS.fetch(chip)).compact
    end

    private

    def of_avr(path)
      variables = IO.popen(['avr-nm', '-S', path], &:readlines).grep(/ [bd] /i).map(&:split).select { |row| row.size == 4 }
      port, others = variables.partition { |row| row.last.start_with?('ticks_') }
      { 'port' => bytes(port.map { |address, size,| [address.hex & 0xFFFF, size.hex] }),
        'application' => bytes(others.map { |address, size,| [address.hex & 0xFFFF, size.hex] }), 'stack' => AVR_STACK }
    end

    # Of its sections; a PIC16's return addresses are not in RAM.
    def of_pic(path)
      map = File.read(path)
      rows = map.scan(/^ *(\S+) +udata +0x(\h+) +data +0x(\h+)$/).map { |name, address, size| [name, address.hex, size.hex] }
                .reject { |name, address,| name.include?('_registers_') || address >= 0xF60 }
      stack = map[/^ *_stack_end +0x(\h+)/, 1]
      rows.reject! { |_, address, size| stack && address + size - 1 == stack.hex }
      port, others = rows.partition { |name,| name.match?(/port/) }
      { 'port' => bytes(port.map { |row| row.drop(1) }), 'application' => bytes(others.map { |row| row.drop(1) }),
        'stack' => stack && "stack:fe1:#{stack.hex.to_s(16)}" }
    end

    def bytes(ranges)
      raise Host::Failure, 'no variables are known of a place' if ranges.empty?

      ranges.map { |address, size| format('%x-%x', address, address + size - 1) }.join(',')
    end
  end
end

def run_faults_of_places
  FaultPlaces::CHIPS.each_key do |name|
    chip = CHIP_FAULTS.fetch(name)
    firmware = Dir["#{Host.root}/build/firmware/#{name}.{cod,elf}"].first or raise Host::Failure, "no firmware of #{name}"
    Report.start("faults_places #{name}")
    sizes = JSON.parse(File.read("#{Host.root}/build/firmware/sizes.json"))
    part = sizes.fetch(name).fetch('chip')
    places = FaultPlaces.of(firmware, part)
    count = Extent.long? ? FaultPlaces::LONG_RUNS : FaultPlaces::RUNS
    rows = places.map { |place, bytes| [place, faults_of_place(name, firmware, chip, place, bytes, count)] }.to_h
    Report.number('places', rows)
    drive = faults_of_place(name, firmware, chip, 'drive', FaultPlaces::DRIVE.fetch(part), FaultPlaces::DRIVE_RUNS)
    Report.at_least("the drive's register: flips that stopped it", drive['off'] + drive['out'], 1)
    rows.each { |place, row| check_place(place, row, count) }
  end
end

def faults_of_place(name, firmware, chip, place, bytes, count)
  command = ["#{Host.root}/build/gpsim/#{name}", firmware, '--faults', name]
  paths = halves_of_faults("faults_places-#{name}-#{place}", command, count, 'place', bytes)
  # What gpsim says of a jump to nowhere is between the rows.
  paths.each { |path| File.write(path, File.readlines(path).grep(/\A(loop|#{name}),/).join) }
  all = FaultRuns.read(name, chip.rules, paths)
  safe = chip.rules.fallen || chip.rules.back
  in_time = all.runs.select { |run| run.end == 'back' && run.back_s <= chip.rules.back }
  off = all.runs.select { |run| %w[off fallen].include?(run.end) && run.off_s <= safe }
  beyond = all.runs.count { |run| run.drive_low < chip.rules.duties.first || run.drive_high > chip.rules.duties.last }
  stopped = all.ended('crashed')
  { 'runs' => all.runs.size, 'back' => in_time.count { |run| run.resets.zero? }, 'reset' => in_time.count { |run| run.resets.positive? },
    'off' => off.size, 'out' => all.runs.size - in_time.size - off.size - stopped, 'stopped' => stopped, 'beyond' => beyond,
    'back_s' => in_time.map(&:back_s).max || 0.0 }
end

def check_place(place, row, count)
  what = FaultPlaces::NAMES.fetch(place)
  Report.exactly("#{what}: flips tried", row['runs'], count)
  Report.exactly("#{what}: drive beyond its limits", row['beyond'], 0)
  counts = row.values_at('back', 'reset', 'off', 'out', 'stopped')
  Report.unchanged("#{what}: back, back after a reset, off, out, simulator stopped", counts.join('/')) unless Extent.long?
end
