// Browsers start no worker from a folder (file://). The search's worker runs in a hidden frame then, by the same
// messages.
class FrameWorker extends EventTarget {
  constructor(address) {
    super()
    this.waiting = []
    const frame = document.createElement("iframe")
    frame.hidden = true
    document.body.append(frame)
    this.inside = frame.contentWindow
    this.inside.postMessage = (data) => this.dispatchEvent(new MessageEvent("message", { data }))
    const script = frame.contentDocument.createElement("script")
    script.src = new URL(address, location.href).href
    script.onload = () => {
      const waiting = this.waiting
      this.waiting = undefined
      waiting.forEach((data) => this.postMessage(data))
    }
    frame.contentDocument.body.append(script)
  }

  postMessage(data) {
    if (this.waiting) this.waiting.push(data)
    else this.inside.dispatchEvent(new this.inside.MessageEvent("message", { data }))
  }
}

window.Worker = FrameWorker
