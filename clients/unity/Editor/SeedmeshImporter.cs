using System.IO;
using System.Text;
using UnityEditor.AssetImporters;
using UnityEngine;

namespace Seedmesh.Editor
{
    /// <summary>
    /// Imports a request file as a text, and warns where its model is missing or was made from another text. Nothing is transferred here:
    /// an importer of Unity has to give the same result on every machine.
    /// </summary>
    [ScriptedImporter(1, "seedmesh")]
    public class SeedmeshImporter : ScriptedImporter
    {
        public override void OnImportAsset(AssetImportContext ctx)
        {
            var text = File.ReadAllText(ctx.assetPath, Encoding.UTF8);
            var request = new TextAsset(text);
            ctx.AddObjectToAsset("request", request);
            ctx.SetMainObject(request);
            if (!SeedmeshSync.IsCurrent(ctx.assetPath, text))
                ctx.LogImportWarning("the model is missing or older than the request; use Assets, Seedmesh, Make changed models");
        }
    }
}
