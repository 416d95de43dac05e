declare module 'virtual:worker' {
  const code: string
  export default code
}
interface Window {
  readonly trustedTypes?: {
    createPolicy(name: string, rules: { createScriptURL: (text: string) => string }): { createScriptURL(text: string): unknown }
  }
}
