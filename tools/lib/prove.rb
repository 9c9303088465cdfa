# SPDX-License-Identifier: MIT
# What tools/prove runs: the proofs of test/proof/proofs.txt, and the breaks that they
# must notice, of test/faults.txt and drawn by a machine. Prints a line for each.
require_relative 'prove/assembly'
require_relative 'prove/assembly/breaks'
require_relative 'prove/cbmc'
require_relative 'prove/choice'
require_relative 'prove/coverage'
require_relative 'prove/eva'
require_relative 'prove/exhaustion'
require_relative 'prove/proofs'
require_relative 'prove/seeded'

Encoding.default_external = 'UTF-8' # CBMC's, whatever the locale

BUILD = 'build/prove'.freeze

# Does the work of a list, so many things at a time; prints what each says, in a line
# or several, and gives whether all were good.
def all_good?(list)
  queue = Queue.new
  list.each { |item| queue << item }
  done = 0
  good = true
  lock = Mutex.new
  workers = Array.new(Integer(ENV.fetch('JOBS', '2'))) do
    Thread.new do
      while (item = take(queue))
        fine, *said = yield item
        lock.synchronize do
          done += 1
          good &&= fine
          said.flatten.each { |line| puts "#{fine ? 'ok' : 'FAILED'} #{line}" }
          warn "prove: #{done} of #{list.size}" if $stderr.tty?
        end
      end
    end
  end
  workers.each(&:join)
  good
end

def take(queue)
  queue.pop(true)
rescue ThreadError
  nil # it is empty
end

# Whether a proof holds, and its line.
def prove(proof)
  answer = judge_of(proof).new(proof, BUILD).run
  return [false, "#{proof.name}: #{answer.why}"] unless answer.verdict == :proved

  figures = proof.exhausted? ? '%<properties>d cases' : '%<properties>d properties, %<seconds>.1f s, %<megabytes>d MB'
  [true, "#{proof.name}: #{format(figures, answer.to_h)}"]
end

# Whether a break is noticed, and its line.
def refute(broken)
  answer = broken.in_tree(BUILD) { |tree| judge_of(broken.proof).new(broken.proof, BUILD, tree).run }
  return [true, "#{broken.name}: noticed, #{answer.seconds.round(1)} s"] if answer.verdict == :refuted

  [false, "#{broken.name}: #{answer.verdict == :proved ? 'nobody noticed' : answer.why}"]
end

# Whether Eva has no alarm but those that are pinned, and those.
def no_alarms?(words)
  all = Eva.all
  chosen = all.select { |eva| words.all? { |word| eva.name.split.include?(word) } }
  good = all_good?(chosen, &:judge)
  stale = chosen == all && good ? Eva.pinned - all.flat_map(&:alarms) : []
  puts stale.map { |alarm| "FAILED #{Eva::ALARMS}: no longer true: #{alarm}" }
  puts 'FAILED no driver has these words in its name' if chosen.empty?
  good && stale.empty? && !chosen.empty?
end

# Whether the proofs come to all places, but those that are pinned.
def covered?(proofs, words)
  forms = Coverage.chosen(proofs, words)
  good = all_good?(forms) { |form| form.judge(BUILD) }
  stale = good && words.empty? ? Coverage.pinned - forms.flat_map(&:unreached) : []
  puts stale.map { |place| "FAILED #{Coverage::FILE}: no longer true: #{place}" }
  good && stale.empty?
end

# Whether these proofs come to their ends and their claims.
def reached?(proofs)
  all_good?(Reach.chosen(proofs)) { |reach| reach.judge(BUILD) }
end

# Whether the claims about assembly hold, what they are made by does what the chips'
# simulators do, and breaks are noticed.
def assembly_proved?(words)
  chosen = Assembly.claims.select { |claim| claim.matches?(words) }
  puts "FAILED no claim has these words in its name: #{words.join(' ')}" if chosen.empty?
  outside = Assembly.outside
  puts outside.map { |file| "FAILED #{file}: no table is for its assembly" }
  sets = chosen.map { |claim| Assembly.set_of(claim.image) }.uniq
  images = chosen.map(&:image).uniq.to_h { |image| [image, Assembly.image(image, BUILD)] }
  good = all_good?(sets.map { |set| TableRun.new(set, BUILD) }, &:run)
  good &= all_good?(chosen) { |claim| claim_answer(claim, ClaimText.new(claim, images.fetch(claim.image))) }
  breaks = AssemblyBreaks.new(chosen, BUILD)
  good &= all_good?(breaks.functions) { |function, drawn| breaks.judge(function, drawn) }
  puts "#{chosen.size} claims about assembly, and breaks of #{breaks.functions.size} functions"
  good && outside.empty? && !chosen.empty?
end

# Whether a claim about assembly holds, and its line.
def claim_answer(claim, text)
  answer = ClaimRun.new(claim, text, "#{BUILD}/claim_#{claim.name.tr(' ', '_')}").run
  return [false, "#{claim.name}: #{answer.why}"] unless answer.verdict == :proved

  figures = claim.how == 'trying' ? '%<properties>d cases' : '%<properties>d properties, %<seconds>.1f s'
  [true, "#{claim.name}: #{format(figures, answer.to_h)}"]
end

mode, *words = ARGV
proofs = Proofs.all
$stdout.sync = true
exit(no_alarms?(words) ? 0 : 1) if mode == 'eva'
exit(assembly_proved?(words) ? 0 : 1) if mode == 'assembly'
chosen = mode == 'quick' ? proofs.select(&:quick?) : proofs.select { |proof| proof.matches?(words) }
if chosen.empty?
  warn "prove: no proof has all of these in its name: #{words.join(' ')} (see --list)"
  exit 2
end
if mode == 'list'
  puts chosen.map(&:name)
  exit 0
end

if mode == 'coverage'
  chosen = proofs.select { |proof| (words - [proof.group, proof.form]).empty? }
  abort "FAILED no form has these words in its name: #{words.join(' ')}" if chosen.empty?
  covered = covered?(proofs, words)
  exit(reached?(chosen) && covered ? 0 : 1)
end
seeded = Seeded.all(proofs)
complaints = Proofs.complaints(proofs) + Seeded.complaints(proofs, seeded) + Reach.complaints(proofs)
complaints.each { |complaint| puts "FAILED #{complaint}" }
proved = all_good?(chosen) { |proof| prove(proof) }
if mode == 'quick'
  puts "#{chosen.size} proofs"
  exit(proved && complaints.empty? ? 0 : 1)
end
breaks = seeded.select { |broken| chosen.include?(broken.proof) }
noticed = all_good?(breaks) { |broken| refute(broken) }
choice = Choice.new(proofs, chosen, BUILD)
drawn = all_good?(choice.places) { |place| choice.judge(place) }
reached = reached?(chosen)
covered = !words.empty? || covered?(proofs, words)
puts "#{chosen.size} proofs, #{breaks.size} breaks, and those of #{choice.places.size} functions"
exit(proved && noticed && drawn && reached && covered && complaints.empty? ? 0 : 1)
