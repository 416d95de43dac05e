// Checks of the page as a reader meets it: opened from disk, in a browser, nothing else running.
//
//   node tests/run.mjs [--fixtures FOLDER] [--only TEXT]
//
// Without --fixtures the reports are written first (cargo run --example report_fixtures). Without a browser all is skipped,
// loudly; TRUENESS_REQUIRE_BROWSER=1 makes that a failure. TRUENESS_CHROMIUM names the browser. Two browsers share the checks:
// one alone leaves half of a machine of two cores idle. Checks of the pace have the machine for themselves, at the end.
import { execFileSync } from 'node:child_process'
import { existsSync, mkdtempSync } from 'node:fs'
import { tmpdir } from 'node:os'
import { dirname, join, resolve } from 'node:path'
import { fileURLToPath } from 'node:url'
import { open } from './browser.mjs'
import { alone, checks } from './checks/index.mjs'

const here = dirname(fileURLToPath(import.meta.url))
const option = (name) => (process.argv.includes(name) ? process.argv[process.argv.indexOf(name) + 1] : null)
const known = ['/usr/bin/chromium', '/usr/bin/chromium-browser', '/usr/bin/google-chrome']
const browser = process.env.TRUENESS_CHROMIUM ?? known.find(existsSync)
if (!browser) {
  console.log('SKIPPED: all browser checks. There is no Chromium (set TRUENESS_CHROMIUM to its path).')
  process.exit(process.env.TRUENESS_REQUIRE_BROWSER === '1' ? 1 : 0)
}

function written() {
  const folder = mkdtempSync(join(tmpdir(), 'trueness-fixtures-'))
  // Without -p: the features are those of the tests then, and nothing that they built is built again.
  const cargo = ['run', '--quiet', '--locked', '--example', 'report_fixtures', '--', folder]
  execFileSync('cargo', cargo, { cwd: resolve(here, '../../../..'), stdio: ['ignore', 'ignore', 'inherit'] })
  return folder
}

const folder = resolve(option('--fixtures') ?? written())
const only = option('--only') ?? ''
let failed = 0

/** Runs one check in a session and says how it went. */
async function run([name, check], session) {
  const start = Date.now()
  try {
    await check(session)
    console.log(`ok    ${name} (${((Date.now() - start) / 1000).toFixed(1)} s)`)
  } catch (error) {
    failed++
    console.log(`FAIL  ${name}\n      ${String(error.stack ?? error).split('\n').slice(0, 14).join('\n      ')}`)
  }
  await session.tidy()
}

/** Takes checks off the queue until none is left, in a browser of its own. */
async function work(queue) {
  const session = await open(browser, folder)
  for (let next = queue.shift(); next; next = queue.shift()) await run(next, session)
  await session.close()
}

const chosen = (list) => list.filter(([name]) => name.includes(only))
const together = chosen(checks)
await Promise.all([work(together), work(together)])
await work(chosen(alone))
if (failed) console.log(`${failed} failed`)
process.exit(failed ? 1 : 0)
