import { build, defineConfig, type Plugin } from 'vite'

/** The worker's code as a string (`virtual:worker`): under the page's rules a worker can only start from a blob. */
const workerAsText = (): Plugin => ({
  name: 'worker-as-text',
  resolveId: (id) => (id === 'virtual:worker' ? '\0worker' : null),
  async load(id) {
    if (id !== '\0worker') return null
    const made = await build({
      configFile: false,
      logLevel: 'error',
      build: { write: false, target: 'es2022', lib: { entry: 'src/decode/worker.ts', formats: ['iife'], name: 'worker' } },
    })
    const [first] = Array.isArray(made) ? made : [made]
    if (!first || !('output' in first)) throw new Error('no worker was built')
    return `export default ${JSON.stringify(first.output[0].code)}`
  },
})

/** The script stands inside an HTML element: nothing in it may look like that element's end. */
const safeInsideHtml = (): Plugin => ({
  name: 'safe-inside-html',
  enforce: 'post',
  generateBundle(_options, bundle) {
    for (const file of Object.values(bundle))
      if (file.type === 'chunk') file.code = file.code.replace(/<\/script/gi, '<\\/script').replace(/<!--/g, '<\\!--')
  },
})

export default defineConfig({
  plugins: [workerAsText(), safeInsideHtml()],
  build: {
    target: 'es2022',
    reportCompressedSize: false,
    lib: { entry: 'src/main.ts', formats: ['iife'], name: 'trueness', fileName: () => 'viewer.js' },
  },
})
