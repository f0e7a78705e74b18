// Until the search's worker has answered for the first time the theme keeps only the last message for it. What is typed
// while the worker still starts would take the place of the index, and nothing would ever be found. So what is asked
// before the worker has the index is answered here, and at once: nothing found. The theme asks again when it is ready.
window.Worker = class extends window.Worker {
  postMessage(message) {
    const SETUP = 0, QUERY = 2, RESULT = 3
    if (message.type === SETUP) this.hasIndex = true
    if (this.hasIndex || message.type !== QUERY) super.postMessage(message)
    else {
      const data = { type: RESULT, data: { items: [] } }
      queueMicrotask(() => this.dispatchEvent(new MessageEvent("message", { data })))
    }
  }
}
